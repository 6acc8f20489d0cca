#include <algorithm>
#include <filesystem>

#include "plant/canopy.h"
#include "plant/canopy/clone_variation.h"

namespace bpms {
namespace {

// Streams of random numbers: the pattern's own, and one for each plant, so that a change in how many numbers
// one plant takes leaves the others as they were.
constexpr std::uint64_t pattern_stream = 0, first_plant_stream = 1;

std::vector<std::string> plant_files(const TomlValue& entry) {
  const TomlValue file = entry.get("file");
  const TomlValue folder = entry.get("folder");
  if (static_cast<bool>(file) == static_cast<bool>(folder)) entry.reject("expected one of file and folder");
  if (file) return {file.file_relative(file.string())};
  std::vector<std::string> out;
  const std::string path = folder.file_relative(folder.string());
  std::error_code code;
  for (const auto& found : std::filesystem::directory_iterator(path, code)) {
    if (found.path().extension() == ".bpms") out.push_back(found.path().string());
  }
  if (out.empty()) folder.reject("no .bpms files in " + in_quotes(path));
  std::ranges::sort(out);
  return out;
}

void read_domain(const TomlValue& root, Canopy& canopy) {
  const TomlValue domain = root.require("domain");
  const TomlValue size = domain.require("size_m");
  const std::vector<double> numbers = size.numbers(2);
  canopy.size_m = {numbers[0], numbers[1]};
  if (canopy.size_m.minCoeff() <= 0) size.reject("expected two lengths above 0");
  if (const TomlValue boundary = domain.get("boundary"))
    canopy.periodic = boundary.one_of({"periodic", "open"}) == "periodic";
  constexpr long long largest_seed = 1'000'000'000'000;
  if (const TomlValue seed = domain.get("seed"))
    canopy.seed = static_cast<std::uint64_t>(seed.integer(0, largest_seed));
}

// Reads the plants; the variation of the entry that each belongs to.
std::vector<CloneVariation> read_plants(const TomlValue& root, Canopy& canopy) {
  const TomlValue entries = root.require("plants");
  std::vector<CloneVariation> out;
  double total = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const TomlValue entry = entries[i];
    const TomlValue share = entry.get("probability");
    const double probability = share ? share.number(0, 1e9) : 1.0;
    const CloneVariation variation(entry);
    const std::vector<std::string> files = plant_files(entry);
    for (const std::string& file : files) {
      auto plant = std::make_shared<Plant>(read_plant(file));
      canopy.notes.insert(canopy.notes.end(), plant->warnings.begin(), plant->warnings.end());
      canopy.inputs.insert(canopy.inputs.end(), plant->inputs.begin(), plant->inputs.end());
      canopy.plants.push_back({file, std::move(plant), probability / static_cast<double>(files.size())});
      out.push_back(variation);
    }
    total += probability;
  }
  if (total <= 0) entries.reject("no plant has a probability above 0");
  for (CanopyPlant& plant : canopy.plants) plant.probability /= total;
  return out;
}

std::uint32_t draw_plant(const std::vector<CanopyPlant>& plants, Philox& random) {
  double u = random.uniform();
  for (std::size_t i = 0; i + 1 < plants.size(); ++i) {
    u -= plants[i].probability;
    if (u < 0) return static_cast<std::uint32_t>(i);
  }
  std::size_t last = plants.size() - 1;  // rounding may leave a rest: it goes to the last that can occur
  while (plants[last].probability <= 0) --last;
  return static_cast<std::uint32_t>(last);
}

}  // namespace

Canopy read_canopy(const std::string& path, std::optional<std::uint64_t> seed) {
  const TomlDocument document = TomlDocument::read(path);
  const TomlValue root = document.root();
  Canopy canopy;
  canopy.inputs.push_back(path);
  read_domain(root, canopy);
  if (seed) canopy.seed = *seed;
  const std::vector<CloneVariation> variations = read_plants(root, canopy);
  if (const TomlValue terrain = root.get("terrain")) terrain.reject("terrain is not built yet");

  const TomlValue planting = root.require("planting");
  PlantingField field{canopy.size_m, canopy.periodic, Philox(canopy.seed, pattern_stream), {}, {}, 0};
  const TomlValue depth_key = planting.get("depth_m");
  const std::vector<PlantingSite> sites = find_pattern(planting.require("pattern"))(planting, field);
  const MeanSd depth = depth_key ? mean_sd(depth_key) : MeanSd{};
  document.finish();

  constexpr double worth_a_note = 0.005;
  const auto planted = static_cast<double>(sites.size());
  if (field.wanted > 0 && std::abs(planted / field.wanted - 1) > worth_a_note)
    field.notes.push_back(
        fmt::format("{} plants, {:.6g} were asked for: what falls outside an open domain is left out",
                    sites.size(), field.wanted));
  canopy.notes.insert(canopy.notes.end(), field.notes.begin(), field.notes.end());
  canopy.inputs.insert(canopy.inputs.end(), field.inputs.begin(), field.inputs.end());
  canopy.placements.reserve(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    Philox random(canopy.seed, first_plant_stream + i);
    Placement placement;
    placement.plant = draw_plant(canopy.plants, random);
    const CloneVariation& variation = variations[placement.plant];
    const double rotation = variation.rotation(random);
    placement.rotation = sites[i].rotation.value_or(rotation);
    placement.scale = variation.scale(random);
    placement.position_m << sites[i].xy_m, sites[i].z_m - depth.mean - depth.sd * random.normal();
    canopy.placements.push_back(placement);
  }
  return canopy;
}

}  // namespace bpms
