// Where a sensor stands and how it is turned, as all kinds of sensors write it:
//   location = [x, y, z]   metres; not below the ground, within 1e7 m
//   look_at = [x, y, z]  or  direction = [dx, dy, dz]
//   up = [x, y, z]         fixes the roll; default z, or north (y) where the sensor looks along z
// and what else their readers share.
#pragma once
#include <Eigen/Core>

#include "simulate/sensors/sensor.h"

namespace bpms {

// Unit vectors at right angles, right x down = look: the axes x, y, z of a camera in the scene.
struct SensorPose {
  Eigen::Vector3d location_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d look = -Eigen::Vector3d::UnitZ();
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  Eigen::Vector3d down = -Eigen::Vector3d::UnitY();
};

SensorPose read_placement(const TomlValue& table, const Scene& scene);
Eigen::Vector3d read_vector(const TomlValue& value);
Eigen::Vector3d read_direction(const TomlValue& value);                  // unit
Eigen::Vector3d read_place(const TomlValue& value, const Scene& scene);  // a location
void reject_below_ground(const TomlValue& value, const Scene& scene, double lowest_m, const char* what);

struct PixelGrid {
  int columns = 0, rows = 0;
  std::size_t pixels() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
};
inline constexpr int most_pixels_a_side = 20000;
PixelGrid read_image_size(const TomlValue& table);  // width_px, height_px

// Pixels count by rows from the top; the centre of (column, row) is at these integers.
struct PixelIndex {
  double column, row;
};
PixelIndex pixel_of(std::size_t view, int columns);

// Zenith and azimuth of a direction, in degrees, in the scene's convention; azimuth 0 ... 360.
struct Angles {
  double zenith_deg, azimuth_deg;
};
Angles angles_of(const Eigen::Vector3d& direction, const Domain& domain);

// No point of the scene is higher.
double highest_m(const Scene& scene);

Ray ray_of(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction);

}  // namespace bpms
