#include "simulate/sensors/calibrated_camera.h"

#include <Eigen/LU>
#include <cmath>

#include "core/units.h"

namespace bpms {
namespace {

// A lens model bends back on itself outside the region that it was fitted to; the borders of the pixels there
// show it, the corners of the image first.
void require_rays(const TomlValue& rig, const Camera& lens) {
  const auto check = [&](double column, double row) {
    const auto ray = unproject(lens, {column, row});
    constexpr double least_z = 0.01;  // 89.4 degrees from the axis: beyond, a perspective image has no place
    if (ray && !(ray->z() > least_z))
      rig.reject(
          fmt::format("the lens of camera {} sees pixel ({}, {}) {:.0f} degrees off its axis: expected less "
                      "than 89 (see type = \"spherical\")",
                      in_quotes(lens.name), column, row, degrees(std::acos(ray->z()))));
    if (!ray)
      rig.reject(
          fmt::format("the lens of camera {} cannot be inverted at pixel ({}, {}): its distortion "
                      "turns back there",
                      in_quotes(lens.name), column, row));
  };
  for (int column = 0; column <= lens.width_px; ++column)
    for (const int row : {0, lens.height_px}) check(column - 0.5, row - 0.5);
  for (int row = 0; row <= lens.height_px; ++row)
    for (const int column : {0, lens.width_px}) check(column - 0.5, row - 0.5);
  constexpr int inside = 32;
  for (int i = 1; i < inside; ++i)
    for (int k = 1; k < inside; ++k)
      check(lens.width_px * (1.0 * i / inside) - 0.5, lens.height_px * (1.0 * k / inside) - 0.5);
}

SensorPose read_rig_placement(const TomlValue& value, const Camera& camera) {
  if (!value.is_array() || value.size() != 3) value.reject("expected the 3 rows of a 3x4 matrix [R | t]");
  Eigen::Matrix3d r;
  Eigen::Vector3d t;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::vector<double> numbers = value[i].numbers(4);
    const auto row = static_cast<Eigen::Index>(i);
    r.row(row) << numbers[0], numbers[1], numbers[2];
    t[row] = numbers[3];
  }
  constexpr double tolerance = 1e-6;
  if (!((r * r.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < tolerance) ||
      r.determinant() < 0)
    value.reject("the left 3x3 block is no rotation");
  return placement_in_scene(camera, r, t);
}

}  // namespace

SensorPose placement_in_scene(const Camera& camera, const Eigen::Matrix3d& r_scene_from_rig,
                              const Eigen::Vector3d& t_scene_from_rig_m) {
  const Eigen::Matrix3d r_scene_from_cam = r_scene_from_rig * camera.r_cam_from_rig.transpose();
  return {t_scene_from_rig_m - r_scene_from_cam * camera.t_cam_from_rig_m, r_scene_from_cam.col(2),
          r_scene_from_cam.col(0), r_scene_from_cam.col(1)};
}

void read_calibrated_camera(const TomlValue& table, const SensorContext& context, PerspectiveSensor& out) {
  const TomlValue rig_key = table.require("rig");
  for (const char* key : {"zoom", "fov_deg", "pixel_size_um", "pixel_aspect"})
    if (const TomlValue value = table.get(key))
      value.reject("the rig's camera says its field: expected none");
  const std::string name = table.require("camera").string();
  context.inputs.push_back(rig_key.file_relative(rig_key.string()));
  const Rig rig = read_rig(context.inputs.back());
  const int index = rig.find(name);
  if (index < 0) {
    std::string names;
    for (const Camera& camera : rig.cameras) names += (names.empty() ? "" : ", ") + in_quotes(camera.name);
    table.require("camera").reject(
        fmt::format("no camera {} in the rig: expected one of {}", in_quotes(name), names));
  }
  out.lens = rig.cameras[static_cast<std::size_t>(index)];
  out.size = {out.lens->width_px, out.lens->height_px};
  const auto require_size = [&](const char* key, int has) {
    const TomlValue value = table.get(key);
    if (value && value.integer(1, most_pixels_a_side) != has)
      value.reject(
          fmt::format("camera {} has {} x {} pixels", in_quotes(name), out.size.columns, out.size.rows));
  };
  require_size("width_px", out.size.columns);
  require_size("height_px", out.size.rows);
  if (std::max(out.size.columns, out.size.rows) > most_pixels_a_side)
    rig_key.reject(fmt::format("expected at most {} pixels a side", most_pixels_a_side));
  require_rays(rig_key, *out.lens);
  const TomlValue pose = table.get("scene_from_rig");
  if (static_cast<bool>(pose) == table.has("location"))
    table.reject_choice("expected one of scene_from_rig (the rig's own pose) and location");
  if (!pose) {
    out.camera = read_placement(table, context.scene);
    return;
  }
  for (const char* key : {"look_at", "direction", "up"})
    if (const TomlValue value = table.get(key)) value.reject("scene_from_rig says it already");
  out.camera = read_rig_placement(pose, *out.lens);
  if (out.camera.location_m.cwiseAbs().maxCoeff() > 1e7) pose.reject("expected a camera within 1e7 m");
  reject_below_ground(pose, context.scene, out.camera.location_m.z(), "the camera");
}

}  // namespace bpms
