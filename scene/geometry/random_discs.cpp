#include "scene/geometry/random_discs.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "core/units.h"

namespace bpms {
namespace {

// The distributions are 2/pi (1 + a cos 2t + b cos 4t) but for the spherical one, sin t.
struct Harmonics {
  double a, b;
};
Harmonics harmonics(LeafAngles angles) {
  switch (angles) {
    case LeafAngles::planophile:
      return {1, 0};
    case LeafAngles::erectophile:
      return {-1, 0};
    case LeafAngles::plagiophile:
      return {0, -1};
    case LeafAngles::extremophile:
      return {0, 1};
    default:
      return {0, 0};
  }
}

double cumulative(const Harmonics& h, double t) {
  return 2 / pi * (t + h.a * std::sin(2 * t) / 2 + h.b * std::sin(4 * t) / 4);
}

// Mean of |n . direction| over azimuth, for leaf inclination l and zenith t (Warren Wilson 1960).
double projection(double l, double t) {
  const double flat = std::cos(l) * std::cos(t);
  if (l + t <= pi / 2) return flat;
  const double x = std::acos(std::clamp(-flat / (std::sin(l) * std::sin(t)), -1.0, 1.0));
  return flat * (2 * x / pi - 1) + 2 / pi * std::sin(l) * std::sin(t) * std::sin(x);
}

}  // namespace

double leaf_angle_density(LeafAngles angles, double t) {
  if (angles == LeafAngles::spherical) return std::sin(t);
  const Harmonics h = harmonics(angles);
  return 2 / pi * (1 + h.a * std::cos(2 * t) + h.b * std::cos(4 * t));
}

double leaf_angle_quantile(LeafAngles angles, double u) {
  if (angles == LeafAngles::spherical) return std::acos(1 - u);
  const Harmonics h = harmonics(angles);
  double low = 0, high = pi / 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (cumulative(h, middle) < u ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double g_function(LeafAngles angles, double zenith) {
  if (angles == LeafAngles::spherical) return 0.5;
  // Simpson on both sides of the kink of the projection at l = pi/2 - t.
  const double kink = pi / 2 - zenith;
  const auto integral = [&](double from, double to) {
    constexpr int steps = 400;
    const double h = (to - from) / steps;
    double sum = 0;
    for (int i = 0; i <= steps; ++i) {
      const double l = from + i * h;
      const double weight = i == 0 || i == steps ? 1 : i % 2 ? 4 : 2;
      sum += weight * leaf_angle_density(angles, l) * projection(l, zenith);
    }
    return sum * h / 3;
  };
  return integral(0, kink) + integral(kink, pi / 2);
}

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
