#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "plant/canopy.h"
#include "plant/canopy/canopy_ground.h"
#include "plant/canopy/domain.h"
#include "plant/canopy/reduce_overlap.h"

namespace bpms {
namespace {

void note_density(const PlantingField& field, std::size_t planted, Canopy& canopy) {
  constexpr double worth_a_note = 0.005;
  if (field.wanted > 0 && std::abs(static_cast<double>(planted) / field.wanted - 1) > worth_a_note)
    canopy.notes.push_back(
        fmt::format("{} plants, {:.6g} were asked for{}", planted, field.wanted,
                    field.periodic ? "" : ": what falls outside an open domain is left out"));
}

}  // namespace

Canopy parse_canopy(const std::string& path, std::string_view text, const CanopyReadOptions& options) {
  const TomlDocument document = TomlDocument::parse(path, text);
  const TomlValue root = document.root();
  Canopy canopy;
  canopy.inputs.push_back(path);
  PlantingField field = read_canopy_domain(root, options, canopy);
  const TomlValue planting = root.require("planting");
  const std::unique_ptr<PlantSource> source = read_plant_source(root);
  const Standing standing = read_standing(planting);
  const CanopyOverlapOptions overlap = read_overlap(root);
  field.want_freedom = overlap.at_most.has_value();
  const std::vector<PlantingSite> sites = find_pattern(planting.require("pattern"))(planting, field);
  canopy.size_m = field.size_m;
  if (field.snap_domain) root.get("domain").get("snap").reject("this pattern has no rows and no grid to fit");
  const bool named =
      std::any_of(sites.begin(), sites.end(), [](const auto& site) { return bool(site.plant); });
  if (!source && !named) root.require("plants");
  canopy.ground = read_canopy_ground(root, field, canopy);
  document.finish();

  note_density(field, sites.size(), canopy);
  canopy.notes.insert(canopy.notes.end(), field.notes.begin(), field.notes.end());
  canopy.inputs.insert(canopy.inputs.end(), field.inputs.begin(), field.inputs.end());
  place_plants(sites, field, standing, source.get(), planting, canopy);
  handle_overlap(root, overlap, sites, field, standing, source.get(), canopy);
  return canopy;
}

Canopy read_canopy(const std::string& path, std::optional<std::uint64_t> seed) {
  return parse_canopy(path, read_text(path), {seed});
}

}  // namespace bpms
