#include "tests/simulate/random_canopy.h"

#include <fmt/format.h>

#include <cmath>

#include "core/random.h"
#include "core/units.h"

namespace bpms::test {

std::string disc_list(const RandomCanopy& c) {
  Philox random(c.seed, 77);
  const auto count = std::lround(c.lai * c.side_m * c.side_m / (pi * c.radius_m * c.radius_m));
  std::string out;
  for (long i = 0; i < count; ++i) {
    const double z = random.uniform(-1, 1), azimuth = random.uniform(0, 2 * pi), s = std::sqrt(1 - z * z);
    const double x = random.uniform(-0.5, 0.5) * c.side_m, y = random.uniform(-0.5, 0.5) * c.side_m;
    const double height = random.uniform(0.05, c.height_m);
    out += fmt::format("{} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f}\n", c.radius_m, x, y, height,
                       s * std::cos(azimuth), s * std::sin(azimuth), z);
  }
  return out;
}

}  // namespace bpms::test
