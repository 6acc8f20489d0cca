#include <map>

#include "simulate/sensors/sensor.h"

namespace bpms {
namespace {
const std::map<std::string, SensorReader> sensor_kinds{
    {"albedo", read_albedo_sensor},
    {"brf", read_brf_sensor},
    {"orthographic", read_orthographic_sensor},
    {"perspective", read_perspective_sensor},
    {"radiometer", read_radiometer_sensor},
    {"rays", read_ray_list_sensor},
    {"spherical", read_spherical_sensor},
};
const std::map<std::string, SeriesReader> sensor_series{
    {"boom", read_boom_sensors},
};
}  // namespace

SensorList read_sensors(const TomlValue& table, const SensorContext& context) {
  const TomlValue name = table.require("name");
  if (name.string().empty()) name.reject("expected a name");
  std::vector<std::string> known;
  for (const auto& kind : sensor_kinds) known.push_back(kind.first);
  for (const auto& kind : sensor_series) known.push_back(kind.first);
  const TomlValue type = table.require("type");
  if (type.is_string() && type.string() == "lidar")
    type.reject("sensors of type \"lidar\" are not built yet");
  const std::string kind = type.one_of(known);
  SensorList out;
  if (const auto series = sensor_series.find(kind); series != sensor_series.end())
    out = series->second(table, context);
  else
    out.push_back(sensor_kinds.at(kind)(table, context));
  for (const auto& sensor : out) {
    sensor->name = name.string() + sensor->name;
    sensor->type = kind;
    sensor->where = table.where();
  }
  return out;
}

std::unique_ptr<Sensor> read_sensor(const TomlValue& table, const SensorContext& context) {
  SensorList all = read_sensors(table, context);
  if (all.size() != 1)
    table.require("type").reject(fmt::format("it stands for {} sensors: expected one", all.size()));
  return std::move(all.front());
}

Extent extent_of(const Intersector& intersector) {
  return {intersector.cell_low_m().cast<double>(), intersector.cell_high_m().cast<double>(),
          intersector.top_m(), intersector.bottom_m()};
}

}  // namespace bpms
