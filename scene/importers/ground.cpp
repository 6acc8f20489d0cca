#include "scene/importers/ground.h"

#include "plant/terrain.h"

namespace bpms {
namespace {

constexpr double highest_ground_m = 1e7;

void read_dem(const TomlValue& table, Scene& scene, Ground& out) {
  if (const TomlValue outside = table.get("outside_height_m")) {
    if (scene.domain.periodic) outside.reject("a periodic domain has no outside");
    out.height_m = outside.number(-highest_ground_m, highest_ground_m);
    out.plane_outside = true;
  }
  out.terrain = read_terrain(table, scene.domain.periodic ? &scene.domain.size_m : nullptr, scene.inputs);
}

}  // namespace

Ground read_ground(const TomlValue& table, MaterialNames& names, Scene& scene) {
  const TomlValue type = table.require("type");
  Ground out;
  if (type.one_of({"plane", "dem"}) == "dem") {
    read_dem(table, scene, out);
  } else if (const TomlValue height = table.get("height_m")) {
    out.height_m = height.number(-highest_ground_m, highest_ground_m);
  }
  const TomlValue material = table.require("material");
  out.material = names.number(material.string(), material.where());
  return out;
}

}  // namespace bpms
