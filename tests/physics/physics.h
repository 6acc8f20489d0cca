// Whole runs of scenes written as scene.toml, and comparisons in standard errors. Light is "brf" throughout
// (irradiance pi on the horizontal), so that a view's radiance is its reflectance factor and the mean
// radiance of an albedo camera the albedo, or the transmittance where it looks up.
#pragma once
#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "core/units.h"
#include "tests/simulate/scene_text.h"
#include "tests/simulate/spread.h"

namespace bpms::test {

// The one sensor's results over a scene with further tables after it.
inline SensorResult run_of(const TemporaryFolder& folder, const SceneText& scene,
                           const std::string& more = "", std::uint64_t seed = 1) {
  return simulate(read_simulation(folder.write("scene.toml", scene.str() + more)), seed).sensors.at(0);
}

// Of the sensor's total.
inline Mean estimate_of(const SensorResult& result, std::size_t at = 0) {
  return {result.radiance[0].value.at(at), result.radiance[0].standard_error.at(at)};
}

// Within 4 standard errors. `most_error`: how large the error may be, as a fraction of the value, for the
// comparison to mean anything. Results without variance carry the rounding of 32-bit weights.
inline constexpr double rounding_of_weights = 1e-5;
inline void expect_agree(const Mean& found, const Mean& expected, double most_error,
                         const std::string& what) {
  const double error = std::hypot(found.error, expected.error);
  EXPECT_LT(error, most_error * std::abs(expected.value)) << what;
  EXPECT_LT(std::abs(found.value - expected.value),
            4 * error + rounding_of_weights * std::abs(expected.value))
      << what << ": " << found.value << " +- " << found.error << ", expected " << expected.value << " +- "
      << expected.error << ", z " << (found.value - expected.value) / error;
}

// A rectangle over the whole cell of 2 x 2 m at a height, with (U,V) from 0 to 1.
inline std::string sheet_obj(double height_m, double half_m = 1) {
  return fmt::format(
      "v {1} {1} {0}\nv {2} {1} {0}\nv {2} {2} {0}\nv {1} {2} {0}\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
      "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n",
      height_m, -half_m, half_m);
}

inline const char* const albedo_down = "name = \"albedo\"\ntype = \"albedo\"\n";
inline std::string looking_up(double height_m) {
  return fmt::format("name = \"under\"\ntype = \"albedo\"\nlooking = \"up\"\nheight_m = {}\n", height_m);
}

// Leaves of two colours and any tilt over soil, LAI 2 in a cell of 2 x 2 m.
inline SceneText mixed_canopy(const TemporaryFolder& folder) {
  SceneText scene =
      canopy_text(folder, {.lai = 2, .radius_m = 0.1, .size_m = {2, 2}, .bottom_m = 0.1, .top_m = 0.8});
  scene.leaf = bilambertian("0.45", "0.35");
  return scene;
}

}  // namespace bpms::test
