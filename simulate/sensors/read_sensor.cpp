#include <map>

#include "simulate/sensors/sensor.h"

namespace bpms {
namespace {
const std::map<std::string, SensorReader> sensor_kinds{
    {"brf", read_brf_sensor},
    {"perspective", read_perspective_sensor},
};
}  // namespace

std::unique_ptr<Sensor> read_sensor(const TomlValue& table, const SensorContext& context) {
  const TomlValue name = table.require("name");
  if (name.string().empty()) name.reject("expected a name");
  std::vector<std::string> known;
  for (const auto& kind : sensor_kinds) known.push_back(kind.first);
  const TomlValue type = table.require("type");
  for (const char* later : {"orthographic", "spherical", "albedo", "lidar", "flux"})
    if (type.is_string() && type.string() == later)
      type.reject(
          fmt::format("sensors of type \"{}\" are not built yet: expected brf or perspective", later));
  auto out = sensor_kinds.at(type.one_of(known))(table, context);
  out->name = name.string();
  out->type = type.string();
  return out;
}

Extent extent_of(const Intersector& intersector) {
  return {intersector.cell_low_m().cast<double>(), intersector.cell_high_m().cast<double>(),
          intersector.top_m(), intersector.bottom_m()};
}

}  // namespace bpms
