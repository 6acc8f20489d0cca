#include "simulate/sensors/albedo.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "simulate/sensors/directions.h"

namespace bpms {

Eigen::Vector3d AlbedoSensor::aperture(const SensorNumbers& random, const Extent& extent) const {
  if (location_m) {
    const Eigen::Vector2d at = radius_m * in_unit_disc(random.u, random.v);
    return *location_m + Eigen::Vector3d(at.x(), at.y(), 0);
  }
  const Eigen::Vector2d at =
      extent.low_m + (extent.high_m - extent.low_m).cwiseProduct(Eigen::Vector2d(random.u, random.v));
  // A hair above the highest point, and above the ground where it lies on it.
  const double hair = 1e-4 * (1.0 + std::abs(extent.top_m));
  const double height = height_m ? *height_m : extent.top_m;
  const bool lift = !height_m || height - extent.bottom_m < hair;
  return {at.x(), at.y(), lift ? height + hair : height};
}

Ray AlbedoSensor::start(std::size_t view, const SensorNumbers& random, const Extent& extent) const {
  const PixelIndex sector = pixel_of(view, sectors.columns);
  // The sine squared of the angle to the axis is even under the cosine.
  const double sine2 = (sector.row + random.s) / sectors.rows;
  const double azimuth = 2 * pi * (sector.column + random.t) / sectors.columns;
  Eigen::Vector3d direction =
      direction_from_angles(std::asin(std::sqrt(std::min(1.0, sine2))), azimuth, domain);
  if (down) direction.z() = -direction.z();
  return ray_of(aperture(random, extent), direction);
}

std::unique_ptr<Sensor> read_albedo_sensor(const TomlValue& table, const SensorContext& context) {
  auto out = std::make_unique<AlbedoSensor>();
  const TomlValue looking = table.get("looking");
  const TomlValue height = table.get("height_m");
  const TomlValue location = table.get("location");
  const TomlValue radius = table.get("radius_m");
  const TomlValue zeniths = table.get("zeniths"), azimuths = table.get("azimuths");
  out->domain = context.scene.domain;
  out->down = !looking || looking.one_of({"down", "up"}) == "down";
  if (location && height) height.reject("location says the height already");
  if (radius && !location)
    radius.reject("expected location with it: without, the aperture is the whole cell");
  if (!out->down && !height && !location)
    table.reject_choice("expected height_m or location: where is the light that comes down to be known?");
  if (height) {
    out->height_m = height.number(-1e7, 1e7);
    reject_below_ground(height, context.scene, *out->height_m, "a receiver");
  }
  if (location) out->location_m = read_place(location, context.scene);
  if (radius) out->radius_m = radius.number(0, 1e7);
  constexpr long long most = 1000;
  if (zeniths) out->sectors.rows = static_cast<int>(zeniths.integer(1, most));
  if (azimuths) out->sectors.columns = static_cast<int>(azimuths.integer(1, most));
  return out;
}

}  // namespace bpms
