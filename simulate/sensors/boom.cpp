#include "simulate/sensors/boom.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace bpms {
namespace {

// The camera at the end of the boom, looking at the point.
struct BoomArm {
  double zenith;  // radians, >= 0
  SensorPose camera;
};
BoomArm arm_of(const Boom& boom, const ViewAngles& view, const Domain& domain) {
  const double zenith = radians(std::abs(view.vza_deg));
  const double azimuth = radians(view.vza_deg < 0 ? view.vaa_deg + 180 : view.vaa_deg);
  const Eigen::Vector3d towards = direction_from_angles(zenith, azimuth, domain);
  const Eigen::Vector3d down = direction_from_angles(zenith + pi / 2, azimuth, domain);
  return {zenith, {boom.about_m + boom.distance_m * towards, -towards, towards.cross(down), down}};
}

int rows_for(const Boom& boom, double height_over_nadir) {
  return std::max(1, static_cast<int>(std::lround(boom.nadir.rows * height_over_nadir)));
}

std::string boom_suffix(const ViewAngles& view, bool azimuths_differ) {
  const auto part = [](double angle_deg) {
    return (angle_deg < 0 ? "_m" : "_") + fmt::format("{}", std::abs(angle_deg));
  };
  return part(view.vza_deg) + (azimuths_differ ? part(view.vaa_deg) : "");
}

}  // namespace

BoomField boom_field(double height_m, double distance_m, double zenith) {
  const double across = 0.5 * height_m * std::cos(zenith), nearer = 0.5 * height_m * std::sin(zenith);
  return {std::atan2(across, distance_m - nearer), std::atan2(across, distance_m + nearer)};
}

std::unique_ptr<OrthographicSensor> orthographic_on_boom(const Boom& boom, const ViewAngles& view,
                                                         const Domain& domain) {
  const BoomArm arm = arm_of(boom, view, domain);
  auto out = std::make_unique<OrthographicSensor>();
  out->camera = arm.camera;
  out->width_m = boom.width_m;
  out->height_m = boom.height_m * std::cos(arm.zenith);
  out->size = {boom.nadir.columns, rows_for(boom, std::cos(arm.zenith))};
  out->zenith_deg = view.vza_deg;
  out->azimuth_deg = view.vaa_deg;
  return out;
}

std::unique_ptr<PerspectiveSensor> perspective_on_boom(const Boom& boom, const ViewAngles& view,
                                                       const Domain& domain) {
  const BoomArm arm = arm_of(boom, view, domain);
  const BoomField field = boom_field(boom.height_m, boom.distance_m, arm.zenith);
  const double half = 0.5 * (field.near_edge + field.far_edge);
  const double turn = 0.5 * (field.near_edge - field.far_edge);  // from the point towards the near edge
  auto out = std::make_unique<PerspectiveSensor>();
  out->camera = arm.camera;
  out->camera.look = std::cos(turn) * arm.camera.look + std::sin(turn) * arm.camera.down;
  out->camera.down = std::cos(turn) * arm.camera.down - std::sin(turn) * arm.camera.look;
  out->semi_height = std::tan(half);
  out->semi_width = 0.5 * boom.width_m / (boom.distance_m * std::cos(turn));
  const double shape = out->semi_height / out->semi_width;
  out->size = {boom.nadir.columns, rows_for(boom, shape * boom.width_m / boom.height_m)};
  out->zenith_deg = view.vza_deg;
  out->azimuth_deg = view.vaa_deg;
  return out;
}

SensorList read_boom_sensors(const TomlValue& table, const SensorContext& context) {
  const Domain& domain = context.scene.domain;
  Boom boom;
  for (const char* key : {"about", "distance_m", "area_m", "projection", "width_px", "height_px"})
    table.get(key);
  const std::vector<ViewAngles> views = read_view_list(table, context);
  boom.about_m = read_place(table.require("about"), context.scene);
  const TomlValue distance = table.require("distance_m"), area = table.require("area_m");
  boom.distance_m = distance.positive();
  if (!area.is_array() || area.size() != 2)
    area.reject("expected [w, h] in metres: across and along the plane of the boom");
  boom.width_m = area[0].positive();
  boom.height_m = area[1].positive();
  boom.nadir = read_image_size(table);
  const TomlValue projection = table.get("projection");
  const bool perspective = projection && projection.one_of({"orthographic", "perspective"}) == "perspective";
  const bool azimuths_differ = std::any_of(
      views.begin(), views.end(), [&](const ViewAngles& v) { return v.vaa_deg != views.front().vaa_deg; });
  const double top_m = highest_m(context.scene);
  SensorList out;
  for (const ViewAngles& view : views) {
    const double zenith = radians(std::abs(view.vza_deg));
    std::unique_ptr<Sensor> sensor;
    if (perspective) {
      const double clearance = boom.distance_m - 0.5 * boom.height_m * std::sin(zenith);
      if (!(clearance > 0.01 * boom.height_m))
        distance.reject(
            fmt::format("at {} degrees the camera stands {:.3g} m from the near edge of the area: "
                        "expected a longer boom",
                        view.vza_deg, clearance));
      sensor = perspective_on_boom(boom, view, domain);
    } else {
      auto image = orthographic_on_boom(boom, view, domain);
      image->above = image->lowest_m() > top_m;
      reject_below_ground(distance, context.scene, image->lowest_m(),
                          fmt::format("at {} degrees the image plane", view.vza_deg).c_str());
      sensor = std::move(image);
    }
    sensor->name = boom_suffix(view, azimuths_differ);
    for (const auto& other : out)
      if (other->name == sensor->name) table.reject(fmt::format("two views at {} degrees", view.vza_deg));
    out.push_back(std::move(sensor));
  }
  return out;
}

}  // namespace bpms
