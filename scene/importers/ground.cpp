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

void check_canopy_ground(const Domain& canopy, const Domain& scene, const TomlValue& domain) {
  if (scene.periodic == canopy.periodic && (!scene.periodic || scene.size_m == canopy.size_m)) return;
  domain.reject(
      fmt::format("the canopy has terrain, made for its own {} domain of {:.9g} x {:.9g} m: leave [domain] "
                  "size_m and boundary out, or change them in the canopy's file",
                  canopy.periodic ? "periodic" : "open", canopy.size_m.x(), canopy.size_m.y()));
}

void check_same_ground(const Ground& canopys, const Ground& scenes, const TomlValue& table) {
  const auto refuse = [&](const char* what) {
    table.reject(fmt::format("the canopy brings its own terrain and {}: leave [ground] out", what));
  };
  if (!scenes.terrain) refuse("this is a plane");
  const Terrain &own = *canopys.terrain, &other = *scenes.terrain;
  constexpr double rounding = 1e-6;  // of a square's side
  const double near = rounding * own.spacing_m.minCoeff();
  if (own.columns != other.columns || own.rows != other.rows || (own.low_m - other.low_m).norm() > near ||
      (own.spacing_m - other.spacing_m).norm() > near || own.heights_m != other.heights_m)
    refuse("this terrain differs from it");
  if (canopys.material != scenes.material) refuse("this is of another material");
  if (canopys.plane_outside != scenes.plane_outside || canopys.height_m != scenes.height_m)
    refuse("outside_height_m differs");
}

}  // namespace bpms
