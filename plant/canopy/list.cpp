// Plants where a list says: positions = [[x, y], [x, y, z], ...] or the name of a file with rows x y [z
// [rotation_deg]].
#include "core/text.h"
#include "core/units.h"
#include "plant/canopy/pattern.h"

namespace bpms {

std::vector<PlantingSite> plant_list(const TomlValue& planting, PlantingField& field) {
  const TomlValue positions = planting.require("positions");
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
  std::size_t outside = 0;
  for (const std::vector<double>& row : rows) {
    PlantingSite site{{row[0], row[1]}, row.size() > 2 ? row[2] : 0.0, {}};
    if (row.size() > 3) site.rotation = radians(row[3]);
    if (!field.holds(site.xy_m)) ++outside;
    out.push_back(site);
  }
  if (outside > 0)
    field.notes.push_back(
        fmt::format("{} of {} listed plants stand outside the domain", outside, rows.size()));
  return out;
}

}  // namespace bpms
