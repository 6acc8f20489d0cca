// Scenes for tests, written as scene.toml and read back by the reader that users meet; and ways to their
// results.
#pragma once
#include <cmath>
#include <string>

#include "scene/geometry/random_discs.h"
#include "simulate/simulate.h"
#include "tests/data.h"
#include "tests/scene_text.h"

namespace bpms::test {

inline Simulation simulation_of(const TemporaryFolder& folder, const SceneText& scene) {
  return read_simulation(folder.write("scene.toml", scene.str()));
}
// The results of the one sensor.
inline SensorResult sensor_result(const TemporaryFolder& folder, const SceneText& scene,
                                  std::uint64_t seed = 1) {
  return simulate(simulation_of(folder, scene), seed).sensors.at(0);
}

// A disc list file of these discs.
inline std::string disc_list(const std::vector<Disc>& discs) {
  std::string out;
  for (const Disc& disc : discs)
    out += fmt::format("{} {} {} {} {} {} {}\n", disc.radius_m, disc.centre_m.x(), disc.centre_m.y(),
                       disc.centre_m.z(), disc.normal.x(), disc.normal.y(), disc.normal.z());
  return out;
}

// Random discs over soil in their periodic cell.
inline SceneText canopy_text(const TemporaryFolder& folder, const RandomDiscs& what) {
  folder.write("canopy.def", disc_list(random_discs(what)));
  return {.domain = fmt::format("size_m = [{}, {}]", what.size_m.x(), what.size_m.y()),
          .leaf = bilambertian("0.5", "0.4"),
          .soil = lambertian("0.2"),
          .discs = "canopy.def"};
}

inline const Estimates& part_of(const SensorResult& result, const Part& part) {
  const std::size_t at = result.place_of(part);
  if (at == result.parts.size()) throw Error(ErrorKind::internal, "no such part");
  return result.radiance[at];
}
// Of all suns together.
inline const Estimates& part_of(const SensorResult& result, Origin origin,
                                Component component = Component::all, int order = every_order) {
  return part_of(result, Part{origin, component, order, every_sun});
}

// A difference in its standard errors.
inline double z_of(const Estimates& a, std::size_t at_a, const Estimates& b, std::size_t at_b) {
  return (a.value[at_a] - b.value[at_b]) / std::hypot(a.standard_error[at_a], b.standard_error[at_b]);
}

}  // namespace bpms::test
