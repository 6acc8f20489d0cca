#include "plant/canopy/place_plants.h"

#include <algorithm>
#include <filesystem>

#include "core/parallel.h"
#include "core/units.h"
#include "plant/canopy/plant_files.h"

namespace bpms {
namespace {

// One stream of random numbers for each plant, so that a change in how many numbers one takes leaves the
// others as they were.
constexpr std::uint64_t first_plant_stream = 1;

// The plants that a stem map names come after those of the source.
void add_named_plants(const PlantingField& field, Canopy& canopy, PlantSet& set) {
  std::vector<std::string> files;
  for (const NamedPlant& named : field.named_plants) {
    std::error_code code;
    files.push_back(named.file);
    if (!std::filesystem::exists(named.file, code))
      bad_input(named.where, "there is no plant file {}", in_quotes(named.file));
  }
  PlantSet named = read_plant_files(files);
  for (CanopyPlant& plant : named.plants) plant.probability = 0;  // none is drawn
  set.plants.insert(set.plants.end(), named.plants.begin(), named.plants.end());
  set.inputs.insert(set.inputs.end(), named.inputs.begin(), named.inputs.end());
  set.notes.insert(set.notes.end(), named.notes.begin(), named.notes.end());
  canopy.plants = std::move(set.plants);
  canopy.inputs.insert(canopy.inputs.end(), set.inputs.begin(), set.inputs.end());
  canopy.notes.insert(canopy.notes.end(), set.notes.begin(), set.notes.end());
}

void stand_on_ground(const Standing& standing, const Canopy& canopy, Placement& placement) {
  if (!canopy.ground) return;
  const Terrain& terrain = *canopy.ground->terrain;
  const Eigen::Vector2d xy = placement.position_m.head<2>();
  if (standing.above_ground) placement.position_m.z() += terrain.height_m(xy);
  if (standing.along_normal) placement.up = terrain.normal(xy).cast<float>();
}

void check_on_terrain(const std::vector<PlantingSite>& sites, const Canopy& canopy,
                      const TomlValue& planting) {
  if (!canopy.ground) return;
  const Terrain& terrain = *canopy.ground->terrain;
  const Eigen::Vector2d rounding = 1e-9 * terrain.size_m();
  for (const PlantingSite& site : sites) {
    if (terrain.covers(site.xy_m + rounding) || terrain.covers(site.xy_m - rounding)) continue;
    planting.reject(fmt::format("a plant at ({:.9g}, {:.9g}) stands beside the terrain, {:.9g} x {:.9g} m",
                                site.xy_m.x(), site.xy_m.y(), terrain.size_m().x(), terrain.size_m().y()));
  }
}

}  // namespace

Standing read_standing(const TomlValue& planting) {
  Standing out;
  if (const TomlValue depth = planting.get("depth_m")) out.depth_m = mean_sd(depth);
  if (const TomlValue tilt = planting.get("tilt"))
    out.along_normal = tilt.one_of({"vertical", "normal"}) == "normal";
  if (const TomlValue heights = planting.get("heights"))
    out.above_ground = heights.one_of({"above_ground", "absolute"}) == "above_ground";
  return out;
}

void place_plants(const std::vector<PlantingSite>& sites, const PlantingField& field,
                  const Standing& standing, PlantSource* source, const TomlValue& planting, Canopy& canopy) {
  check_on_terrain(sites, canopy, planting);
  // Sites that name no plant draw theirs, numbered by themselves.
  std::vector<std::size_t> number(sites.size());
  std::size_t drawn = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) number[i] = sites[i].plant ? 0 : drawn++;
  if (drawn > 0 && source == nullptr)
    planting.reject(fmt::format("{} places name no plant: expected [[plants]] to draw from", drawn));
  PlantSet set;
  if (drawn > 0) set = source->stand(drawn, canopy.seed);
  const auto first_named = static_cast<std::uint32_t>(set.plants.size());
  add_named_plants(field, canopy, set);

  canopy.placements.resize(sites.size());
  constexpr std::size_t batch = 4096;
  parallel_for((sites.size() + batch - 1) / batch, [&](std::size_t b) {
    for (std::size_t i = b * batch; i < std::min(sites.size(), (b + 1) * batch); ++i) {
      const PlantingSite& site = sites[i];
      Philox random(canopy.seed, first_plant_stream + i);
      PlantDraw draw;
      if (site.plant)
        draw = {first_named + *site.plant, random.uniform(0, 2 * pi), 1};
      else
        draw = source->draw(number[i], random);
      const double depth = standing.depth_m.mean + standing.depth_m.sd * random.normal();
      Placement& out = canopy.placements[i];
      out.plant = draw.plant;
      out.rotation = site.rotation.value_or(draw.rotation);
      out.scale = site.scale.value_or(draw.scale);
      out.position_m << site.xy_m, site.z_m - depth;
      stand_on_ground(standing, canopy, out);
    }
  });
}

void move_placement(const Eigen::Vector2d& to, const Standing& standing, const Canopy& canopy,
                    Placement& placement) {
  if (canopy.ground && standing.above_ground)
    placement.position_m.z() -= canopy.ground->terrain->height_m(placement.position_m.head<2>());
  placement.position_m.head<2>() = to;
  stand_on_ground(standing, canopy, placement);
}

}  // namespace bpms
