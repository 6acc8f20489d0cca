// Lights that a scene is given after it was read: a map of the sky, the directions of a sun's disc.
#pragma once
#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <vector>

#include "core/units.h"
#include "simulate/simulate.h"

namespace bpms::test {

// radiance(row, column, band) on a grid of 10 zeniths and 24 azimuths, in the place of the scene's sky.
inline Simulation with_sky_map(Simulation simulation,
                               const std::function<float(std::size_t, std::size_t, std::size_t)>& radiance) {
  constexpr std::size_t zeniths = 10, azimuths = 24;
  const std::size_t bands = simulation.bands.count();
  std::vector<float> values;
  for (std::size_t row = 0; row < zeniths; ++row)
    for (std::size_t column = 0; column < azimuths; ++column)
      for (std::size_t band = 0; band < bands; ++band) values.push_back(radiance(row, column, band));
  simulation.light.sky = sky_of(std::make_shared<SkyMap>(zeniths, azimuths, bands, values));
  return simulation;
}

// Evenly over the disc of this radius (radians).
inline std::vector<Eigen::Vector3d> disc_directions(const Eigen::Vector3d& centre, double radius, int rings,
                                                    int steps) {
  const Eigen::Vector3d side = centre.unitOrthogonal(), other = centre.cross(side);
  std::vector<Eigen::Vector3d> out;
  for (int ring = 0; ring < rings; ++ring) {
    const double z = 1 - (ring + 0.5) / rings * (1 - std::cos(radius)), r = std::sqrt(1 - z * z);
    for (int step = 0; step < steps; ++step) {
      const double angle = 2 * pi * (step + 0.5 * (ring % 2)) / steps;
      out.push_back(z * centre + r * (std::cos(angle) * side + std::sin(angle) * other));
    }
  }
  return out;
}

}  // namespace bpms::test
