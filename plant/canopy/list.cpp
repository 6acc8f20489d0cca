// Plants where a list says: positions = [[x, y], [x, y, z], ...] or the name of a file with rows x y [z
// [rotation_deg]]; or where a stem map says, table = "stems.csv" (stem_map.h).
#include "core/text.h"
#include "core/units.h"
#include "plant/canopy/pattern.h"
#include "plant/canopy/stem_map.h"

namespace bpms {
namespace {

std::vector<PlantingSite> listed_sites(const TomlValue& positions, PlantingField& field) {
  std::vector<std::vector<double>> rows;
  if (positions.is_string()) {
    field.inputs.push_back(positions.file_relative(positions.string()));
    rows = read_number_table(field.inputs.back(), 2, 4, "x y [z [rotation_deg]] in metres and degrees").rows;
  } else {
    for (std::size_t i = 0; i < positions.size(); ++i) {
      rows.push_back(positions[i].numbers());
      if (rows.back().size() < 2 || rows.back().size() > 4)
        positions[i].reject("expected [x, y], [x, y, z] or [x, y, z, rotation_deg]");
    }
  }
  if (rows.empty()) positions.reject("no positions");
  std::vector<PlantingSite> out;
  out.reserve(rows.size());
  for (const std::vector<double>& row : rows) {
    PlantingSite site{{row[0], row[1]}, row.size() > 2 ? row[2] : 0.0};
    if (row.size() > 3) site.rotation = radians(row[3]);
    out.push_back(site);
  }
  return out;
}

}  // namespace

std::vector<PlantingSite> plant_list(const TomlValue& planting, PlantingField& field) {
  constexpr double farthest_m = 1e7;
  const TomlValue positions = planting.get("positions"), table = planting.get("table");
  if (static_cast<bool>(positions) == static_cast<bool>(table))
    planting.reject_choice("expected one of positions and table");
  std::vector<PlantingSite> out = table ? read_stem_map(table, field) : listed_sites(positions, field);
  field.plant_count(static_cast<double>(out.size()), table ? table : positions);
  std::size_t outside = 0;
  for (const PlantingSite& site : out) {
    if (std::max(site.xy_m.cwiseAbs().maxCoeff(), std::abs(site.z_m)) > farthest_m)
      (table ? table : positions).reject("a position beyond 1e7 m");
    if (!field.holds(site.xy_m)) ++outside;
  }
  if (outside > 0)
    field.notes.push_back(
        fmt::format("{} of {} listed plants stand outside the domain", outside, out.size()));
  return out;
}

}  // namespace bpms
