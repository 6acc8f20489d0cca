#include "tests/simulate/hemisphere.h"

#include <algorithm>

#include "core/random.h"
#include "core/units.h"

namespace bpms::test {

Mean dhr(const TemporaryFolder& folder, SceneText scene) {
  constexpr int drawings = 8, zeniths = 6, azimuths = 12;
  constexpr double most_deg = 89;
  std::vector<double> draws;
  for (std::uint64_t drawing = 1; drawing <= drawings; ++drawing) {
    Philox random(drawing, 5);
    std::string list;
    for (int i = 0; i < zeniths; ++i)
      for (int k = 0; k < azimuths; ++k) {
        const double vza = degrees(std::acos(std::sqrt((i + random.uniform()) / zeniths)));
        const double vaa = 360 * (k + random.uniform()) / azimuths;
        list += fmt::format("[{}, {}], ", std::min(vza, most_deg), vaa);
      }
    scene.sensor = views("[" + list + "]");
    const SensorResult result = sensor_result(folder, scene, drawing);
    double mean = 0;
    for (const double brf : result.radiance[0].value) mean += brf / (zeniths * azimuths);
    draws.push_back(mean);
  }
  return mean_of(draws);
}

}  // namespace bpms::test
