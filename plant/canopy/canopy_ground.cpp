#include "plant/canopy/canopy_ground.h"

#include "plant/canopy/ridges.h"

namespace bpms {
namespace {

// An open field must lie on its terrain; a periodic one fills it (read_terrain).
void check_covers(const Terrain& terrain, const Eigen::Vector2d& size_m, const TomlValue& file) {
  const Eigen::Vector2d rounding = 1e-9 * size_m, high = terrain.low_m + terrain.size_m();
  if (terrain.covers(-0.5 * size_m + rounding) && terrain.covers(0.5 * size_m - rounding)) return;
  file.reject(fmt::format(
      "the terrain, {:.9g} x {:.9g} m, spans x {:.9g} to {:.9g} and y {:.9g} to {:.9g}; expected it to "
      "hold the field, {:.9g} x {:.9g} m about the origin",
      terrain.size_m().x(), terrain.size_m().y(), terrain.low_m.x(), high.x(), terrain.low_m.y(), high.y(),
      size_m.x(), size_m.y()));
}

}  // namespace

std::optional<CanopyGround> read_canopy_ground(const TomlValue& root, PlantingField& field, Canopy& canopy) {
  const TomlValue table = root.get("terrain"), ridges_table = root.get("ridges");
  if (ridges_table && !table)
    ridges_table.reject(
        "expected a table [terrain] beside it, with the ground's material (file may be left out)");
  if (!table) return std::nullopt;
  CanopyGround out;
  const TomlValue material = table.require("material");
  out.material = material.string();
  if (out.material.empty()) material.reject("expected the name of a material");
  if (const TomlValue outside = table.get("outside_height_m")) {
    constexpr double highest_m = 1e7;
    if (field.periodic) outside.reject("a periodic domain has no outside");
    out.outside_height_m = outside.number(-highest_m, highest_m);
  }
  const TomlValue file = table.get("file");
  if (file) {
    out.terrain = read_terrain(table, field.periodic ? &field.size_m : nullptr, canopy.inputs);
    if (!field.periodic) check_covers(*out.terrain, field.size_m, file);
  } else if (!ridges_table) {
    for (const char* key : {"centred", "offset_m"}) table.get(key);
    table.reject_choice("expected file, or a table [ridges]");
  }
  if (!ridges_table) return out;
  const Ridges ridges = read_ridges(ridges_table, field);
  out.terrain = std::make_shared<const Terrain>(
      out.terrain ? ridged_terrain(ridges, *out.terrain, field.periodic, ridges_table)
                  : ridged_ground(ridges, field, ridges_table));
  return out;
}

}  // namespace bpms
