#include "simulate/sensors/orthographic.h"

#include <cmath>

namespace bpms {

Eigen::Vector3d OrthographicSensor::point(double column, double row) const {
  const double x = ((column + 0.5) / size.columns - 0.5) * width_m;
  const double y = ((row + 0.5) / size.rows - 0.5) * height_m;
  return camera.location_m + x * camera.right + y * camera.down;
}

double OrthographicSensor::lowest_m() const {
  return camera.location_m.z() - 0.5 * width_m * std::abs(camera.right.z()) -
         0.5 * height_m * std::abs(camera.down.z());
}

Ray OrthographicSensor::start(std::size_t view, const SensorNumbers& random, const Extent&) const {
  const PixelIndex pixel = pixel_of(view, size.columns);
  return ray_of(point(pixel.column + random.u - 0.5, pixel.row + random.v - 0.5), camera.look);
}

std::optional<Eigen::Vector3d> OrthographicSensor::parallel(std::size_t) const {
  if (!above || !(camera.look.z() < 0)) return std::nullopt;
  return -camera.look;
}

std::unique_ptr<Sensor> read_orthographic_sensor(const TomlValue& table, const SensorContext& context) {
  auto out = std::make_unique<OrthographicSensor>();
  const TomlValue width = table.get("width_m"), height = table.get("height_m");
  out->camera = read_placement(table, context.scene);
  out->size = read_image_size(table);
  if (!width) table.reject_choice("missing key 'width_m'");
  out->width_m = width.positive();
  out->height_m = height ? height.positive() : out->width_m * out->size.rows / out->size.columns;
  constexpr double widest_m = 1e7;
  if (!(out->width_m <= widest_m)) width.reject("expected at most 1e7 m");
  if (!(out->height_m <= widest_m)) (height ? height : width).reject("expected a height of at most 1e7 m");
  reject_below_ground(table.require("location"), context.scene, out->lowest_m(),
                      "a corner of the image plane");
  const Angles angles = angles_of(-out->camera.look, context.scene.domain);
  out->zenith_deg = angles.zenith_deg;
  out->azimuth_deg = angles.azimuth_deg;
  out->above = out->lowest_m() > highest_m(context.scene);
  return out;
}

}  // namespace bpms
