#include "simulate/sensors/spherical.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "core/units.h"

namespace bpms {

// Across and down, with the circle of radius 1.
Eigen::Vector2d SphericalSensor::in_circle(double column, double row) const {
  return {2 * (column + 0.5) / side - 1, 2 * (row + 0.5) / side - 1};
}

Eigen::Vector3d SphericalSensor::outwards(double column, double row) const {
  const Eigen::Vector2d at = in_circle(column, row);
  const double from_middle = at.norm();
  const double radius = from_middle <= 1 ? from_middle : std::max(0.0, 2 - from_middle);
  const double angle = projection == SphereProjection::equal_angle
                           ? radius * pi / 2
                           : 2 * std::asin(radius / std::numbers::sqrt2);
  const Eigen::Vector2d across = from_middle > 0 ? (at / from_middle).eval() : Eigen::Vector2d::Zero();
  const Eigen::Vector3d middle =
      hemisphere == SphereLooking::in ? Eigen::Vector3d(-camera.look) : camera.look;
  return (std::cos(angle) * middle + std::sin(angle) * (across.x() * camera.right + across.y() * camera.down))
      .normalized();
}

Ray SphericalSensor::start(std::size_t view, const SensorNumbers& random, const Extent&) const {
  const PixelIndex pixel = pixel_of(view, side);
  const Eigen::Vector3d out = outwards(pixel.column + random.u - 0.5, pixel.row + random.v - 0.5);
  if (hemisphere == SphereLooking::out) return ray_of(camera.location_m, out);
  return ray_of(camera.location_m + radius_m * out, -out);
}

bool SphericalSensor::covers(std::size_t view) const {
  const PixelIndex pixel = pixel_of(view, side);
  return in_circle(pixel.column, pixel.row).norm() <= 1;
}

Angles SphericalSensor::angles(std::size_t view) const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (!covers(view)) return {none, none};
  const PixelIndex pixel = pixel_of(view, side);
  const Eigen::Vector3d out = outwards(pixel.column, pixel.row);
  return angles_of(hemisphere == SphereLooking::in ? out : Eigen::Vector3d(-out), domain);
}

std::unique_ptr<Sensor> read_spherical_sensor(const TomlValue& table, const SensorContext& context) {
  auto out = std::make_unique<SphericalSensor>();
  const TomlValue looking = table.get("looking");
  const TomlValue projection = table.get("projection");
  const TomlValue radius = table.get("radius_m");
  for (const char* key : {"width_px", "height_px"}) table.get(key);
  out->camera = read_placement(table, context.scene);
  out->domain = context.scene.domain;
  const PixelGrid size = read_image_size(table);
  if (size.columns != size.rows)
    table.require("height_px").reject("expected the width in pixels: the image is a circle in a square");
  out->side = size.columns;
  if (looking && looking.one_of({"in", "out"}) == "out") out->hemisphere = SphereLooking::out;
  if (projection && projection.one_of({"equal_angle", "equal_area"}) == "equal_area")
    out->projection = SphereProjection::equal_area;
  if (out->hemisphere == SphereLooking::out) {
    if (radius) radius.reject("rays start at the location: expected looking = \"in\" with it");
    return out;
  }
  if (!radius) table.reject_choice("missing key 'radius_m', of the hemisphere that rays start from");
  out->radius_m = radius.positive();
  constexpr double widest_m = 1e7;
  if (out->radius_m > widest_m) radius.reject("expected at most 1e7 m");
  // The lowest point of the surface is on its rim, unless the axis points up.
  const double axis_z = out->camera.look.z();
  const double lowest = axis_z > 0 ? -1.0 : -std::sqrt(std::max(0.0, 1 - axis_z * axis_z));
  constexpr double hair = 1e-6;  // of the radius: a rim on the ground is meant, not below it
  reject_below_ground(radius, context.scene, out->camera.location_m.z() + out->radius_m * (lowest + hair),
                      "the hemisphere");
  return out;
}

}  // namespace bpms
