// Directions about a normal: unit, on its side, in the mean as cos / pi has them.
#include "simulate/transport/basis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace bpms {
namespace {

TEST(Basis, SineAndCosineOfATurnAreThoseOfTheLibrary) {
  double most = 0;
  for (int i = 0; i <= 1'000'000; ++i) {
    const float v = static_cast<float>(i) * 1e-6f;
    float sine = 0, cosine = 0;
    sine_cosine_of_turn(v, sine, cosine);
    const double angle = 2 * std::numbers::pi * static_cast<double>(v);
    most = std::max({most, std::abs(static_cast<double>(sine) - std::sin(angle)),
                     std::abs(static_cast<double>(cosine) - std::cos(angle))});
  }
  EXPECT_LT(most, 1.2e-7);  // two roundings of a float near 1
}

TEST(Basis, CosineDirectionsAreUnitAndHaveTheCosineLawsMeans) {
  const Eigen::Vector3f normal = Eigen::Vector3f(0.3f, -0.5f, -0.8f).normalized();
  Philox random(8, 8);
  constexpr int count = 200'000;
  double cosines = 0, squares = 0, across = 0;
  const Basis frame(normal);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3f d = cosine_direction(normal, random.uniform(), random.uniform());
    ASSERT_NEAR(d.norm(), 1, 1e-6f);
    const auto cosine = static_cast<double>(normal.dot(d));
    ASSERT_GT(cosine, -1e-6);
    cosines += cosine / count, squares += cosine * cosine / count;
    across += static_cast<double>(frame.to_local(d).x()) / count;
  }
  // cos has the mean 2/3 and the variance 1/18, its square 1/2 and 1/12, a sideways part 0 and 1/4.
  EXPECT_NEAR(cosines, 2.0 / 3, 4 * std::sqrt(1.0 / 18 / count));
  EXPECT_NEAR(squares, 0.5, 4 * std::sqrt(1.0 / 12 / count));
  EXPECT_NEAR(across, 0, 4 * std::sqrt(0.25 / count));
}

}  // namespace
}  // namespace bpms
