#include "plant/canopy/plant_sources.h"

namespace bpms {

std::unique_ptr<PlantSource> read_plant_source(const TomlValue& root) {
  const TomlValue planting = root.get("planting"), entries = root.get("plants");
  const TomlValue mode = planting.get("mode"), order = planting.get("order");
  const bool once = mode && mode.one_of({"clones", "explicit"}) == "explicit";
  if (order && !once) order.reject("only plants that stand once have an order: mode = \"explicit\"");
  const bool shuffled = order && order.one_of({"listed", "shuffled"}) == "shuffled";
  if (!entries) {
    if (mode) mode.reject("there are no [[plants]]");
    return nullptr;
  }
  if (entries.size() == 0) entries.reject("no plants");
  return once ? explicit_source(entries, shuffled) : clone_source(entries);
}

}  // namespace bpms
