#include "simulate/sensors/placement.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace bpms {
namespace {
constexpr double farthest_m = 1e7;  // beyond, floats have no place for a plant
constexpr double shortest_vector = 1e-9;
}  // namespace

Eigen::Vector3d read_vector(const TomlValue& value) {
  const std::vector<double> numbers = value.numbers(3);
  return {numbers[0], numbers[1], numbers[2]};
}

Eigen::Vector3d read_direction(const TomlValue& value) {
  const Eigen::Vector3d out = read_vector(value);
  if (!(out.norm() > shortest_vector)) value.reject("expected a vector with a length");
  return out.normalized();
}

void reject_below_ground(const TomlValue& value, const Scene& scene, double lowest_m, const char* what) {
  if (!scene.ground || lowest_m >= scene.ground->height_m) return;
  value.reject(
      fmt::format("{} at z = {} m lies below the ground at {} m", what, lowest_m, scene.ground->height_m));
}

Eigen::Vector3d read_place(const TomlValue& value, const Scene& scene) {
  const Eigen::Vector3d out = read_vector(value);
  if (out.cwiseAbs().maxCoeff() > farthest_m) value.reject("expected a point within 1e7 m");
  reject_below_ground(value, scene, out.z(), "a sensor");
  return out;
}

SensorPose read_placement(const TomlValue& table, const Scene& scene) {
  SensorPose out;
  const TomlValue location = table.get("location");
  const TomlValue look_at = table.get("look_at");
  const TomlValue direction = table.get("direction");
  const TomlValue up_key = table.get("up");
  if (!location) table.reject_choice("missing key 'location'");
  out.location_m = read_place(location, scene);
  if (static_cast<bool>(look_at) == static_cast<bool>(direction))
    table.reject_choice("expected one of look_at and direction");
  if (direction) {
    out.look = read_direction(direction);
  } else {
    const Eigen::Vector3d look = read_vector(look_at) - out.location_m;
    if (!(look.norm() > shortest_vector)) look_at.reject("expected a point away from the sensor");
    out.look = look.normalized();
  }
  constexpr double parallel = 1e-6;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  if (up_key)
    up = read_direction(up_key);
  else if (out.look.cross(up).norm() < parallel)
    up = Eigen::Vector3d::UnitY();
  if (out.look.cross(up).norm() < parallel) up_key.reject("up is parallel to the line of sight");
  out.right = out.look.cross(up).normalized();
  out.down = out.look.cross(out.right);
  return out;
}

PixelGrid read_image_size(const TomlValue& table) {
  const TomlValue columns = table.get("width_px"), rows = table.get("height_px");
  if (!columns) table.reject_choice("missing key 'width_px'");
  if (!rows) table.reject_choice("missing key 'height_px'");
  return {static_cast<int>(columns.integer(1, most_pixels_a_side)),
          static_cast<int>(rows.integer(1, most_pixels_a_side))};
}

PixelIndex pixel_of(std::size_t view, int columns) {
  const auto width = static_cast<std::size_t>(columns);
  const std::size_t row = view / width, column = view % width;
  return {static_cast<double>(column), static_cast<double>(row)};
}

Angles angles_of(const Eigen::Vector3d& direction, const Domain& domain) {
  const double across = std::hypot(direction.x(), direction.y());
  if (across == 0) return {direction.z() < 0 ? 180.0 : 0.0, 0.0};
  const double azimuth_deg =
      degrees(domain.azimuth_north_clockwise ? std::atan2(direction.x(), direction.y())
                                             : std::atan2(direction.y(), direction.x()));
  return {degrees(std::atan2(across, direction.z())), azimuth_deg < 0 ? azimuth_deg + 360 : azimuth_deg};
}

double highest_m(const Scene& scene) {
  double out = scene.ground ? scene.ground->height_m : -1e30;
  std::vector<double> top(scene.prototypes.size(), -1e30);
  for (std::size_t p = 0; p < scene.prototypes.size(); ++p) {
    const Prototype& prototype = scene.prototypes[p];
    for (const Disc& disc : prototype.discs)
      top[p] = std::max(top[p], static_cast<double>(disc.centre_m.z() + disc.radius_m));
    if (prototype.mesh)
      for (const Eigen::Vector3f& at : prototype.mesh->positions_m)
        top[p] = std::max(top[p], static_cast<double>(at.z()));
  }
  for (const Instance& instance : scene.instances)
    out = std::max(out, instance.position_m.z() + instance.scale * top[instance.prototype]);
  return out;
}

Ray ray_of(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  Ray out;
  out.origin = origin.cast<float>();
  out.direction = direction.cast<float>();
  return out;
}

}  // namespace bpms
