#include "simulate/forward/choose_mode.h"

#include <algorithm>

#include "simulate/forward/shared_views.h"

namespace bpms {

Mode read_mode(const TomlValue& value) {
  const std::string name = value.one_of({"reverse", "forward", "auto"});
  return name == "reverse" ? Mode::reverse : name == "forward" ? Mode::forward : Mode::automatic;
}

Mode choose_mode(Mode asked, const Simulation& simulation, const Sensor& sensor,
                 const SourceLocation& where) {
  if (asked == Mode::reverse) return asked;
  std::string why;
  const bool can = can_share_paths(simulation, sensor, &why);
  if (asked == Mode::forward) {
    if (!can)
      bad_input(where, "sensor {} cannot share paths between its views: {}; expected mode = \"reverse\"",
                in_quotes(sensor.name), why);
    return asked;
  }
  if (!can) return Mode::reverse;
  const auto& prototypes = simulation.scene.prototypes;
  const bool meshes = std::any_of(prototypes.begin(), prototypes.end(),
                                  [](const Prototype& prototype) { return prototype.mesh != nullptr; });
  const std::size_t worth = meshes ? views_worth_sharing : views_worth_sharing_grids;
  return sensor.views() >= worth ? Mode::forward : Mode::reverse;
}

}  // namespace bpms
