// Sensors as sources of rays. A view is a direction of a `brf` sensor or a pixel of an image; each has its
// own estimate. `start` maps the unit square to the view's rays: origin and direction of travel (away from
// the sensor). To add a kind: its own file with a reader and a line in the table of read_sensor.cpp.
#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>

#include "scene/intersect/intersector.h"
#include "simulate/light/light.h"

namespace bpms {

// What rays start above: the horizontal cell (or the open scene's box) and its heights.
struct Extent {
  Eigen::Vector2d low_m, high_m;
  double top_m = 0, bottom_m = 0;
};
Extent extent_of(const Intersector& intersector);

class Sensor {
 public:
  virtual ~Sensor() = default;
  std::string name;
  std::string type;

  virtual std::size_t views() const = 0;
  virtual Ray start(std::size_t view, double u, double v, const Extent& extent) const = 0;
  // Towards the sensor, where all rays of the view are parallel and start above the scene.
  virtual std::optional<Eigen::Vector3d> parallel(std::size_t) const { return std::nullopt; }
  // Towards the sensor, in degrees as the file writes them; NaN for a pixel.
  virtual double vza_deg(std::size_t view) const = 0;
  virtual double vaa_deg(std::size_t view) const = 0;
  // Images: pixels by rows from the top; 0 for a list of directions.
  virtual int width() const { return 0; }
  virtual int height() const { return 0; }
  bool is_image() const { return width() > 0; }
};

std::unique_ptr<Sensor> read_brf_sensor(const TomlValue& table, const Domain& domain, const Light& light);
std::unique_ptr<Sensor> read_perspective_sensor(const TomlValue& table, const Domain& domain,
                                                const Light& light);
std::unique_ptr<Sensor> read_sensor(const TomlValue& table, const Domain& domain, const Light& light);

}  // namespace bpms
