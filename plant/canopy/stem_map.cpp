#include "plant/canopy/stem_map.h"

#include <filesystem>
#include <map>

#include "core/csv.h"
#include "core/units.h"

namespace bpms {
namespace {

// A column that may be absent, and cells of it that may be empty.
class OptionalColumn {
 public:
  OptionalColumn(const CsvTable& table, const char* name) : table_(table), column_(table.find(name)) {}
  bool given(std::size_t row) const { return column_ >= 0 && !table_.empty(row, column_); }
  std::optional<double> number(std::size_t row) const {
    return given(row) ? std::optional(table_.number(row, column_)) : std::nullopt;
  }
  std::string text(std::size_t row) const { return std::string(table_.text(row, column_)); }
  SourceLocation where(std::size_t row) const { return table_.where(row, column_); }

 private:
  const CsvTable& table_;
  int column_;
};

// The number of a file among those named so far.
std::uint32_t named_plant(const CsvTable& table, const OptionalColumn& column, std::size_t row,
                          std::map<std::string, std::uint32_t>& known, PlantingField& field) {
  const std::string name = column.text(row);
  const auto next = static_cast<std::uint32_t>(field.named_plants.size());
  const auto found = known.try_emplace(name, next);
  if (found.second) {
    const std::filesystem::path file(name);
    const std::filesystem::path beside = std::filesystem::path(table.path()).parent_path() / file;
    field.named_plants.push_back({(file.is_absolute() ? file : beside).string(), column.where(row)});
  }
  return found.first->second;
}

}  // namespace

std::vector<PlantingSite> read_stem_map(const TomlValue& key, PlantingField& field) {
  constexpr double largest_scale = 1e6;
  field.inputs.push_back(key.file_relative(key.string()));
  const CsvTable table = CsvTable::read(field.inputs.back());
  const int x = table.require("x_m"), y = table.require("y_m");
  const OptionalColumn z(table, "z_m"), rotation(table, "rotation_deg"), scale(table, "scale"),
      plant(table, "plant");
  if (table.rows() == 0) bad_input({table.path()}, "no plants in the stem map");
  std::map<std::string, std::uint32_t> known;
  std::vector<PlantingSite> out;
  out.reserve(table.rows());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    PlantingSite site{{table.number(row, x), table.number(row, y)}, z.number(row).value_or(0)};
    if (const auto angle = rotation.number(row)) site.rotation = radians(*angle);
    site.scale = scale.number(row);
    if (site.scale && !(*site.scale > 0 && *site.scale <= largest_scale))
      bad_input(scale.where(row), "scale {}, expected a factor above 0 and up to 1e6", *site.scale);
    if (plant.given(row)) site.plant = named_plant(table, plant, row, known, field);
    out.push_back(site);
  }
  return out;
}

}  // namespace bpms
