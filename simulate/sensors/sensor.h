// Sensors as sources of rays. A view is a direction of a `brf` sensor, a pixel of an image, a line of sight
// of a list; each has its own estimate, the mean of what its rays see. `start` maps random numbers to the
// view's rays: origin and direction of travel (away from the sensor). To add a kind: its own file with a
// reader and a line in a table of read_sensor.cpp.
#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/intersect/intersector.h"
#include "simulate/light/light.h"

namespace bpms {

// What rays start above: the horizontal cell (or the open scene's box) and its heights.
struct Extent {
  Eigen::Vector2d low_m, high_m;
  double top_m = 0, bottom_m = 0;
};
Extent extent_of(const Intersector& intersector);

// Uniform in (0, 1): (u, v) over the pixel or the cell, (s, t) over the aperture or the hemisphere.
struct SensorNumbers {
  double u, v, s = 0.5, t = 0.5;
};

// A view's value is the mean radiance of its rays; that of a receiver of irradiance is pi times it, with rays
// distributed as the cosine to its normal.
enum class Measures { radiance, irradiance };

class Sensor {
 public:
  virtual ~Sensor() = default;
  std::string name;
  std::string type;
  SourceLocation where{};  // of its table

  virtual std::size_t views() const = 0;
  virtual Ray start(std::size_t view, const SensorNumbers& random, const Extent& extent) const = 0;
  virtual bool uses_aperture() const { return false; }  // (s, t) too
  // False for the corners of a picture that are no part of the image: they have no estimate.
  virtual bool covers(std::size_t) const { return true; }
  virtual Measures measures() const { return Measures::radiance; }
  // Of a receiver of irradiance: the unit normal of the face that receives; the sun shines on it directly
  // too.
  virtual std::optional<Eigen::Vector3d> faces(std::size_t) const { return std::nullopt; }
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

// What a reader may look at; files that it reads are added to `inputs`, remarks to `notes`.
struct SensorContext {
  const Scene& scene;
  const Light& light;
  std::vector<std::string>& inputs;
  std::vector<std::string>& notes;
};
using SensorReader = std::unique_ptr<Sensor> (*)(const TomlValue& table, const SensorContext& context);
std::unique_ptr<Sensor> read_brf_sensor(const TomlValue& table, const SensorContext& context);
std::unique_ptr<Sensor> read_perspective_sensor(const TomlValue& table, const SensorContext& context);
std::unique_ptr<Sensor> read_orthographic_sensor(const TomlValue& table, const SensorContext& context);
std::unique_ptr<Sensor> read_spherical_sensor(const TomlValue& table, const SensorContext& context);
std::unique_ptr<Sensor> read_albedo_sensor(const TomlValue& table, const SensorContext& context);
std::unique_ptr<Sensor> read_radiometer_sensor(const TomlValue& table, const SensorContext& context);
std::unique_ptr<Sensor> read_ray_list_sensor(const TomlValue& table, const SensorContext& context);

// A kind that stands for several sensors, such as the pictures along a boom; their names come back as what
// follows the table's own.
using SensorList = std::vector<std::unique_ptr<Sensor>>;
using SeriesReader = SensorList (*)(const TomlValue& table, const SensorContext& context);
SensorList read_boom_sensors(const TomlValue& table, const SensorContext& context);

// What one [[sensors]] table stands for, at least one sensor.
SensorList read_sensors(const TomlValue& table, const SensorContext& context);
// The same where it is one sensor; a series is refused.
std::unique_ptr<Sensor> read_sensor(const TomlValue& table, const SensorContext& context);

}  // namespace bpms
