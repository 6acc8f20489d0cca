#include "scene/geometry/random_discs.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "core/units.h"

namespace bpms {
std::vector<Disc> random_discs(const RandomDiscs& what) {
  const double area = pi * what.radius_m * what.radius_m;
  const auto count = static_cast<std::size_t>(std::llround(what.lai * what.size_m.prod() / area));
  std::vector<Disc> out;
  out.reserve(count);
  Philox random(what.seed, 0x64697363);
  for (std::size_t k = 0; k < count; ++k) {
    const double x = (random.uniform() - 0.5) * what.size_m.x();
    const double y = (random.uniform() - 0.5) * what.size_m.y();
    const double z = random.uniform(what.bottom_m, what.top_m);
    const double inclination = leaf_angle_quantile(what.angles, random.uniform());
    const double azimuth = 2 * pi * random.uniform();
    const double s = std::sin(inclination);
    const Eigen::Vector3d normal(s * std::cos(azimuth), s * std::sin(azimuth), std::cos(inclination));
    out.push_back(
        {Eigen::Vector3d(x, y, z).cast<float>(), static_cast<float>(what.radius_m), normal.cast<float>()});
  }
  return out;
}

Scene random_disc_scene(const RandomDiscs& what) {
  Scene scene;
  scene.domain.size_m = what.size_m;
  scene.domain.periodic = true;
  scene.materials = {"leaf", "soil"};
  Prototype prototype;
  prototype.name = "discs";
  prototype.discs = random_discs(what);
  scene.prototypes.push_back(std::move(prototype));
  scene.instances.emplace_back();
  scene.ground = Ground{0, 1};
  return scene;
}

}  // namespace bpms
