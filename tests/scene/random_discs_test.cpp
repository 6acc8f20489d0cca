#include "scene/geometry/random_discs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "scene/structure/gap_fraction.h"

namespace bpms {
namespace {

// P = (1 - G a / (A cos t))^N over independent canopies: the spread between canopies gives the standard
// error.
void expect_gaps(LeafAngles angles, std::uint64_t first_seed) {
  constexpr int canopies = 16;
  const std::vector<double> zenith{0, 30, 57.5, 75};
  std::vector<double> sum(zenith.size()), squares(zenith.size());
  RandomDiscs what;
  what.lai = 2;
  what.radius_m = 0.05;
  what.size_m = {6, 6};
  what.bottom_m = what.radius_m;  // no disc dips into the ground
  what.top_m = 1.5;
  what.angles = angles;
  double discs = 0;
  for (int c = 0; c < canopies; ++c) {
    what.seed = first_seed + static_cast<std::uint64_t>(c);
    const Scene scene = random_disc_scene(what);
    discs = static_cast<double>(scene.prototypes[0].discs.size());
    const std::vector<Gap> gaps =
        gap_fraction(GapScene(scene), gap_directions(zenith), {1u << 14, what.seed});
    for (std::size_t k = 0; k < zenith.size(); ++k) {
      sum[k] += gaps[k].plant.p;
      squares[k] += gaps[k].plant.p * gaps[k].plant.p;
    }
  }
  for (std::size_t k = 0; k < zenith.size(); ++k) {
    const double mean = sum[k] / canopies;
    const double se = std::sqrt((squares[k] / canopies - mean * mean) / (canopies - 1));
    const double t = radians(zenith[k]);
    const double shadow =
        g_function(angles, t) * pi * what.radius_m * what.radius_m / (what.size_m.prod() * std::cos(t));
    const double expected = std::pow(1 - shadow, discs);
    EXPECT_LT(std::abs(mean - expected), 4 * se)
        << zenith[k] << " degrees: " << mean << " +- " << se << ", expected " << expected;
    EXPECT_LT(se, 0.02 * expected + 1e-3);  // small enough to bite
  }
}

TEST(RandomDiscs, HaveTheGapFractionOfSphericalLeaves) {
  expect_gaps(LeafAngles::spherical, 100);
}
TEST(RandomDiscs, HaveTheGapFractionOfPlanophileLeaves) {
  expect_gaps(LeafAngles::planophile, 200);
}
TEST(RandomDiscs, HaveTheGapFractionOfErectophileLeaves) {
  expect_gaps(LeafAngles::erectophile, 300);
}

}  // namespace
}  // namespace bpms
