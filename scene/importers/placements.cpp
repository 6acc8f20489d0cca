#include "scene/importers/placements.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "core/units.h"

namespace bpms {
namespace {

constexpr double farthest_place_m = 1e7;

const char* const place_columns = "x y z [rz_deg [ry_deg rx_deg]]";

bool is_place(const std::vector<double>& row) {
  return row.size() == 3 || row.size() == 4 || row.size() == 6;
}
bool too_far(const std::vector<double>& row) {
  return std::any_of(row.begin(), row.begin() + 3, [](double x) { return std::abs(x) > farthest_place_m; });
}

}  // namespace

std::vector<Instance> read_placements(const TomlValue& table, std::vector<std::string>& inputs) {
  std::vector<Instance> out;
  Instance instance;
  if (const TomlValue scale = table.get("scale")) {
    constexpr double largest_scale = 1e6;
    instance.scale = scale.positive();
    if (instance.scale > largest_scale) scale.reject("expected a factor up to 1e6");
  }
  const double turn_deg = table.number_or("rotation_deg", 0);
  const TomlValue positions = table.require("positions");
  const auto place = [&](const std::vector<double>& row) {
    instance.position_m = {row[0], row[1], row[2]};
    const double z = radians(turn_deg + (row.size() > 3 ? row[3] : 0));
    instance.rotation =
        row.size() < 6 ? Rotation(z) : Rotation::about_axes(z, radians(row[4]), radians(row[5]));
    out.push_back(instance);
  };
  if (positions.is_string()) {
    inputs.push_back(positions.file_relative(positions.string()));
    const NumberTable rows = read_number_table(inputs.back(), 3, 6, place_columns);
    for (std::size_t i = 0; i < rows.rows.size(); ++i) {
      const SourceLocation where{rows.file, rows.lines[i]};
      if (!is_place(rows.rows[i])) bad_input(where, "5 columns, expected 3, 4 or 6 ({})", place_columns);
      if (too_far(rows.rows[i])) bad_input(where, "a position beyond 1e7 m");
      place(rows.rows[i]);
    }
    return out;
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const std::vector<double> row = positions[i].numbers();
    if (!is_place(row) || too_far(row))
      positions[i].reject(
          "expected [x, y, z], [x, y, z, rz_deg] or [x, y, z, rz_deg, ry_deg, rx_deg], positions within 1e7 "
          "m");
    place(row);
  }
  if (positions.size() == 0) positions.reject("no positions");
  return out;
}

}  // namespace bpms
