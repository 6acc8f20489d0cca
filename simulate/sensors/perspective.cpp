#include "simulate/sensors/perspective.h"

#include <cmath>

#include "core/units.h"
#include "simulate/sensors/calibrated_camera.h"
#include "simulate/sensors/directions.h"

namespace bpms {

Eigen::Vector3d PerspectiveSensor::line_of_sight(double column, double row) const {
  if (!lens) {
    const double x = (2 * (column + 0.5) / size.columns - 1) * semi_width;
    const double y = (2 * (row + 0.5) / size.rows - 1) * semi_height;
    return camera.look + x * camera.right + y * camera.down;
  }
  const auto ray = unproject(*lens, {column, row});
  if (!ray) fail(ErrorKind::numeric, {}, "camera {}: no ray for pixel ({}, {})", lens->name, column, row);
  return camera.look + (ray->x() * camera.right + ray->y() * camera.down) / ray->z();
}

Ray PerspectiveSensor::start(std::size_t view, const SensorNumbers& random, const Extent&) const {
  const PixelIndex pixel = pixel_of(view, size.columns);
  const Eigen::Vector3d sight = line_of_sight(pixel.column + random.u - 0.5, pixel.row + random.v - 0.5);
  if (!(aperture_radius_m > 0)) return ray_of(camera.location_m, sight.normalized());
  const Eigen::Vector2d at = aperture_radius_m * in_unit_disc(random.s, random.t);
  const Eigen::Vector3d from = at.x() * camera.right + at.y() * camera.down;
  return ray_of(camera.location_m + from, (focus_m * sight - from).normalized());
}

namespace {

constexpr double widest_field_deg = 179.0;

// Of the image: zoom, fov_deg, or focal length and pixel size.
void read_field(const TomlValue& table, const TomlValue& focal_length, PerspectiveSensor& out) {
  const TomlValue zoom = table.get("zoom");
  const TomlValue field = table.get("fov_deg");
  const TomlValue pixel = table.get("pixel_size_um");
  const TomlValue aspect = table.get("pixel_aspect");
  if (static_cast<bool>(zoom) + static_cast<bool>(field) + static_cast<bool>(pixel) != 1)
    table.reject_choice("expected one of zoom, fov_deg and pixel_size_um (with focal_length_mm)");
  const auto columns = static_cast<double>(out.size.columns), rows = static_cast<double>(out.size.rows);
  if (pixel) {
    if (!focal_length) table.reject_choice("missing key 'focal_length_mm', which pixel_size_um needs");
    if (aspect) aspect.reject("pixel_size_um = [width, height] says it already");
    const double f_um = 1000 * focal_length.positive();
    const bool two = pixel.is_array();
    if (two && pixel.size() != 2) pixel.reject("expected a size, or [width, height]");
    out.semi_width = 0.5 * columns * (two ? pixel[0] : pixel).positive() / f_um;
    out.semi_height = 0.5 * rows * (two ? pixel[1] : pixel).positive() / f_um;
  } else {
    out.semi_height =
        zoom ? 1.0 / zoom.positive() : std::tan(0.5 * radians(field.number(0.001, widest_field_deg)));
    out.semi_width = out.semi_height * columns / rows * (aspect ? aspect.positive() : 1.0);
  }
  const double wider = std::max(out.semi_width, out.semi_height);
  if (!(wider <= std::tan(0.5 * radians(widest_field_deg))))
    (zoom    ? zoom
     : field ? field
             : pixel)
        .reject(
            fmt::format("the field is {:.4g} degrees wide: expected at most {} (see type = \"spherical\")",
                        degrees(2 * std::atan(wider)), widest_field_deg));
}

void read_aperture(const TomlValue& table, const TomlValue& focal_length, PerspectiveSensor& out) {
  const TomlValue stop = table.get("f_stop");
  const TomlValue focus = table.get("focus_m");
  if (!stop) {
    if (focus) focus.reject("a pinhole has no focus: give f_stop too");
    return;
  }
  if (!focus) table.reject_choice("missing key 'focus_m', which f_stop needs");
  if (!focal_length) table.reject_choice("missing key 'focal_length_mm', which f_stop needs");
  const double f_m = 1e-3 * focal_length.positive();
  out.aperture_radius_m = 0.5 * f_m / stop.positive();
  out.focus_m = focus.positive();
  if (!(out.focus_m > f_m)) focus.reject("expected a plane beyond the focal length");
}

}  // namespace

std::unique_ptr<Sensor> read_perspective_sensor(const TomlValue& table, const SensorContext& context) {
  auto out = std::make_unique<PerspectiveSensor>();
  const TomlValue focal_length = table.get("focal_length_mm");
  const TomlValue of = table.get("location_of");
  for (const char* key :
       {"location", "look_at", "direction", "up", "zoom", "fov_deg", "pixel_size_um", "pixel_aspect",
        "f_stop", "focus_m", "rig", "camera", "scene_from_rig", "width_px", "height_px"})
    table.get(key);
  const bool calibrated = table.has("rig");
  if (calibrated) {
    read_calibrated_camera(table, context, *out);
  } else {
    for (const char* key : {"camera", "scene_from_rig"})
      if (const TomlValue value = table.get(key)) value.reject("expected rig = \"rig.toml\" with it");
    out->camera = read_placement(table, context.scene);
    out->size = read_image_size(table);
    read_field(table, focal_length, *out);
  }
  read_aperture(table, focal_length, *out);
  if (of && of.one_of({"centre", "image_plane"}) == "image_plane") {
    if (!table.has("location")) of.reject("the pose is the rig's: expected no location_of");
    if (!focal_length) table.reject_choice("missing key 'focal_length_mm', which location_of needs");
    out->camera.location_m += 1e-3 * focal_length.positive() * out->camera.look;
  }
  if (focal_length && !table.has("pixel_size_um") && !table.has("f_stop") && !of)
    focal_length.reject("expected pixel_size_um, f_stop or location_of with it");
  return out;
}

}  // namespace bpms
