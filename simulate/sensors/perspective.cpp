// A pinhole camera. `location` is the perspective centre; it looks at a point or along a direction; `up`
// fixes the roll; zoom = focal length / image semi-height (1 = a vertical field of 90 degrees), or fov_deg,
// the vertical field. Pixels are averages over their square; rows count from the top.
#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "core/units.h"
#include "simulate/sensors/sensor.h"

namespace bpms {
namespace {

class PerspectiveSensor : public Sensor {
 public:
  Eigen::Vector3d location, look, right, down;
  double semi_height = 1;  // at unit distance
  int columns = 0, rows = 0;

  std::size_t views() const override {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  double vza_deg(std::size_t) const override { return std::numeric_limits<double>::quiet_NaN(); }
  double vaa_deg(std::size_t) const override { return std::numeric_limits<double>::quiet_NaN(); }
  int width() const override { return columns; }
  int height() const override { return rows; }

  Ray start(std::size_t view, const SensorNumbers& random, const Extent&) const override {
    const auto column = static_cast<double>(view % static_cast<std::size_t>(columns));
    const std::size_t row_number = view / static_cast<std::size_t>(columns);
    const auto row = static_cast<double>(row_number);
    const double scale = 2.0 * semi_height / rows;
    const double x = (column + random.u - 0.5 * columns) * scale;
    const double y = (row + random.v - 0.5 * rows) * scale;
    Ray out;
    out.origin = location.cast<float>();
    out.direction = (look + x * right + y * down).normalized().cast<float>();
    return out;
  }
};

Eigen::Vector3d vector_of(const TomlValue& value) {
  const std::vector<double> numbers = value.numbers(3);
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

std::unique_ptr<Sensor> read_perspective_sensor(const TomlValue& table, const SensorContext&) {
  auto out = std::make_unique<PerspectiveSensor>();
  constexpr double shortest = 1e-9;
  constexpr int largest = 20000;
  constexpr double farthest_m = 1e7;  // beyond, floats have no place for a plant
  const TomlValue location = table.require("location");
  out->location = vector_of(location);
  if (out->location.cwiseAbs().maxCoeff() > farthest_m) location.reject("expected a point within 1e7 m");
  const TomlValue look_at = table.get("look_at");
  const TomlValue direction = table.get("direction");
  const TomlValue up_key = table.get("up");
  const TomlValue zoom = table.get("zoom");
  const TomlValue field = table.get("fov_deg");
  const TomlValue columns = table.require("width_px"), rows = table.require("height_px");
  if (static_cast<bool>(look_at) == static_cast<bool>(direction))
    table.reject_choice("expected one of look_at and direction");
  const Eigen::Vector3d look =
      look_at ? Eigen::Vector3d(vector_of(look_at) - out->location) : vector_of(direction);
  if (look.norm() < shortest) (look_at ? look_at : direction).reject("expected a point away from the camera");
  out->look = look.normalized();
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  if (up_key)
    up = vector_of(up_key);
  else if (out->look.cross(up).norm() < 1e-6)
    up = Eigen::Vector3d::UnitY();  // straight down: north at the top
  const Eigen::Vector3d right = out->look.cross(up);
  if (right.norm() < shortest * std::max(1.0, up.norm()))
    up_key.reject("up is parallel to the line of sight");
  out->right = right.normalized();
  out->down = out->look.cross(out->right);
  if (static_cast<bool>(zoom) == static_cast<bool>(field))
    table.reject_choice("expected one of zoom and fov_deg");
  out->semi_height = zoom ? 1.0 / zoom.positive() : std::tan(0.5 * radians(field.number(0.001, 179.0)));
  out->columns = static_cast<int>(columns.integer(1, largest));
  out->rows = static_cast<int>(rows.integer(1, largest));
  return out;
}

}  // namespace bpms
