// One leaf in the open: which face is lit and which is seen decide what is gathered.
#include <gmock/gmock.h>

#include "core/units.h"
#include "tests/simulate/scene_text.h"

namespace bpms::test {
namespace {

// A square leaf about (0, 0, 1) that leans by `tilt_deg` from level towards the east; its upper face is the
// front where tilt_deg < 90, and looks down beyond. Seen from either side along its normal, in three bands.
class OneLeaf {
 public:
  explicit OneLeaf(double tilt_deg)
      : normal_(std::sin(radians(tilt_deg)), 0, std::cos(radians(tilt_deg))),
        across_(std::cos(radians(tilt_deg)), 0, -std::sin(radians(tilt_deg))) {
    std::string text;
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      const Eigen::Vector3d at = centre_ + x * across_ + y * Eigen::Vector3d::UnitY();
      text += fmt::format("v {} {} {}\n", at.x(), at.y(), at.z());
    }
    folder_.write("leaf.obj", text + "f 1 2 3\nf 1 3 4\n");
  }
  SensorResult seen(bool from_front, const std::string& material) const {
    const Eigen::Vector3d at = centre_ + (from_front ? 3.0 : -3.0) * normal_;
    const SceneText scene{.domain = "boundary = \"open\"",
                          .leaf = material,
                          .mesh = "leaf.obj",
                          .sun = sun_at(sza, 90, "[[450, 100], [550, 200], [650, 300]]"),
                          .sensor = camera(fmt::format("[{}, {}, {}]", at.x(), at.y(), at.z()),
                                           "look_at = [0, 0, 1]\nup = [0, 1, 0]\nfov_deg = 20", 2, 2),
                          .wavelengths_nm = "[450, 550, 650]",
                          .sampling = "samples = 64"};
    return sensor_result(folder_, scene);
  }
  double cosine() const {
    return normal_.dot(Eigen::Vector3d(std::sin(radians(sza)), 0, std::cos(radians(sza))));
  }

 private:
  static constexpr double sza = 40;  // in the east
  Eigen::Vector3d centre_{0, 0, 1}, normal_, across_;
  TemporaryFolder folder_;
};

constexpr double irradiance[3] = {100, 200, 300};
constexpr double front[3] = {0.05, 0.15, 0.08}, back[3] = {0.12, 0.25, 0.18}, through[3] = {0.02, 0.10, 0.03};

std::string spectrum(const double* values) {
  return fmt::format("[[450, {}], [550, {}], [650, {}]]", values[0], values[1], values[2]);
}

TEST(OneLeaf, ShowsTheColourOfTheFaceThatIsLitOrTheLightThatComesThrough) {
  const std::string leaf =
      bilambertian(spectrum(front), spectrum(through)) + "reflectance_back = " + spectrum(back);
  for (const double tilt : {0.0, 30.0, -40.0, 150.0, 180.0, -60.0}) {
    const OneLeaf one(tilt);
    const bool front_is_lit = one.cosine() > 0;
    for (const bool from_front : {true, false}) {
      const SensorResult result = one.seen(from_front, leaf);
      const double* colour = from_front != front_is_lit ? through : front_is_lit ? front : back;
      for (std::size_t pixel = 0; pixel < 4; ++pixel) {
        for (std::size_t band = 0; band < 3; ++band) {
          const double expected = colour[band] / pi * irradiance[band] * std::abs(one.cosine());
          EXPECT_NEAR(result.radiance[0].value[3 * pixel + band], expected, 1e-5 * irradiance[band])
              << "tilt " << tilt << (from_front ? ", front" : ", back") << ", band " << band;
        }
        EXPECT_EQ(result.sunlit.value[pixel], 1);  // whichever face is lit
        EXPECT_EQ(result.shaded.value[pixel], 0);
        EXPECT_EQ(result.gap.value[pixel], 0);
      }
    }
  }
}

TEST(OneLeaf, WhenOpaqueIsDarkAndShadedBehind) {
  for (const double tilt : {20.0, 160.0}) {
    const OneLeaf one(tilt);
    for (const bool from_front : {true, false}) {
      const SensorResult result = one.seen(from_front, lambertian(spectrum(front)));
      const bool lit = from_front == (one.cosine() > 0);
      for (std::size_t pixel = 0; pixel < 4; ++pixel) {
        for (std::size_t band = 0; band < 3; ++band)
          EXPECT_NEAR(result.radiance[0].value[3 * pixel + band],
                      lit ? front[band] / pi * irradiance[band] * std::abs(one.cosine()) : 0,
                      1e-5 * irradiance[band]);
        EXPECT_EQ(result.sunlit.value[pixel], lit ? 1 : 0);
        EXPECT_EQ(result.shaded.value[pixel], lit ? 0 : 1);
      }
    }
  }
}

}  // namespace
}  // namespace bpms::test
