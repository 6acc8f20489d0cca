// Rays of any scanner or platform that is modelled elsewhere, from a table: x_m, y_m, z_m, dx, dy, dz
// (direction of travel, away from the sensor; any length). Rows with the same text in the optional column
// `view` belong to one view, which is the mean of its rays, by the optional column `weight`; without it each
// row is a view. Views stand in the order of their first rows. Optional column half_angle_deg: the ray
// spreads evenly over a cone. With width_px and height_px the views are the pixels of an image, by rows.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/csv.h"
#include "simulate/sensors/directions.h"
#include "simulate/sensors/placement.h"

namespace bpms {
namespace {

struct ListedRay {
  Eigen::Vector3d origin_m, direction;
  double half_angle = 0;
  double weight = 1;
  SourceLocation where;
};

class RayListSensor : public Sensor {
 public:
  struct View {
    std::vector<ListedRay> rays;
    std::vector<double> cumulative;  // of the weights, the last is 1
  };
  std::vector<View> list;
  PixelGrid size;
  bool divergent = false;
  Domain domain;

  std::size_t views() const override { return list.size(); }
  Ray start(std::size_t view, const SensorNumbers& random, const Extent&) const override {
    const View& of = list[view];
    const auto at = std::upper_bound(of.cumulative.begin(), of.cumulative.end() - 1, random.u);
    const ListedRay& ray = of.rays[static_cast<std::size_t>(at - of.cumulative.begin())];
    if (!(ray.half_angle > 0)) return ray_of(ray.origin_m, ray.direction);
    return ray_of(ray.origin_m, within_cone(Axes(ray.direction), ray.half_angle, random.s, random.t));
  }
  bool uses_aperture() const override { return divergent; }
  double vza_deg(std::size_t view) const override { return angles(view).zenith_deg; }
  double vaa_deg(std::size_t view) const override { return angles(view).azimuth_deg; }
  int width() const override { return size.columns; }
  int height() const override { return size.rows; }

 private:
  // Of the rays' one direction; NaN where they differ.
  Angles angles(std::size_t view) const {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    constexpr double same = 1e-9;
    const std::vector<ListedRay>& rays = list[view].rays;
    for (const ListedRay& ray : rays)
      if ((ray.direction - rays.front().direction).norm() > same) return {none, none};
    return angles_of(-rays.front().direction, domain);
  }
};

struct RayColumns {
  int x, y, z, dx, dy, dz, view, weight, half_angle;
};

ListedRay listed_ray(const CsvTable& table, std::size_t row, const RayColumns& at, const Scene& scene) {
  ListedRay out;
  out.where = table.where(row, at.x);
  out.origin_m = {table.number(row, at.x), table.number(row, at.y), table.number(row, at.z)};
  if (out.origin_m.cwiseAbs().maxCoeff() > 1e7) bad_input(out.where, "expected a point within 1e7 m");
  if (scene.ground && out.origin_m.z() < scene.ground->height_m)
    bad_input(table.where(row, at.z), "z = {} m lies below the ground at {} m", out.origin_m.z(),
              scene.ground->height_m);
  const Eigen::Vector3d direction(table.number(row, at.dx), table.number(row, at.dy),
                                  table.number(row, at.dz));
  if (!(direction.norm() > 1e-9))
    bad_input(table.where(row, at.dx), "the direction is ({}, {}, {}): expected a vector with a length",
              direction.x(), direction.y(), direction.z());
  out.direction = direction.normalized();
  if (at.weight >= 0) {
    out.weight = table.number(row, at.weight);
    if (!(out.weight >= 0))
      bad_input(table.where(row, at.weight), "weight {}: expected 0 or more", out.weight);
  }
  if (at.half_angle >= 0) {
    const double half_angle_deg = table.number(row, at.half_angle);
    if (!(half_angle_deg >= 0 && half_angle_deg <= 90))
      bad_input(table.where(row, at.half_angle), "half_angle_deg {}: expected 0 to 90", half_angle_deg);
    out.half_angle = radians(half_angle_deg);
  }
  return out;
}

void set_cumulative(RayListSensor::View& view) {
  double sum = 0;
  for (const ListedRay& ray : view.rays) view.cumulative.push_back(sum += ray.weight);
  if (!(sum > 0)) bad_input(view.rays.front().where, "the weights of this view add up to 0");
  for (double& value : view.cumulative) value /= sum;
}

}  // namespace

std::unique_ptr<Sensor> read_ray_list_sensor(const TomlValue& table, const SensorContext& context) {
  auto out = std::make_unique<RayListSensor>();
  const TomlValue file = table.get("file");
  const TomlValue width = table.get("width_px"), height = table.get("height_px");
  if (!file) table.reject_choice("missing key 'file'");
  out->domain = context.scene.domain;
  context.inputs.push_back(file.file_relative(file.string()));
  const CsvTable csv = CsvTable::read(context.inputs.back());
  const RayColumns at{csv.require("x_m"), csv.require("y_m"), csv.require("z_m"),
                      csv.require("dx"),  csv.require("dy"),  csv.require("dz"),
                      csv.find("view"),   csv.find("weight"), csv.find("half_angle_deg")};
  if (csv.rows() == 0) bad_input({csv.path()}, "no rays");
  if (at.weight >= 0 && at.view < 0)
    bad_input({csv.path(), 1}, "a column weight without a column view: which rays belong together?");
  std::map<std::string, std::size_t, std::less<>> index;
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    std::size_t view = out->list.size();
    if (at.view >= 0) {
      if (csv.empty(row, at.view)) bad_input(csv.where(row, at.view), "expected the name of a view");
      view = index.try_emplace(std::string(csv.text(row, at.view)), view).first->second;
    }
    if (view == out->list.size()) out->list.emplace_back();
    out->list[view].rays.push_back(listed_ray(csv, row, at, context.scene));
    out->divergent |= out->list[view].rays.back().half_angle > 0;
  }
  for (RayListSensor::View& view : out->list) set_cumulative(view);
  if (width || height) {
    out->size = read_image_size(table);
    if (out->size.pixels() != out->list.size())
      width.reject(fmt::format("{} has {} views: expected width_px x height_px of them", csv.path(),
                               out->list.size()));
  }
  return out;
}

}  // namespace bpms
