#include <cmath>
#include <limits>

#include "apps/bpms/verb.h"
#include "apps/bpms/verbs.h"
#include "core/error.h"
#include "core/progress.h"
#include "core/text.h"
#include "core/toml.h"
#include "plant/plant_file.h"
#include "scene/importers/plants.h"
#include "scene/structure/structure.h"

namespace bpms {
namespace {

struct DescribeArguments {
  std::string file;
  std::uint32_t rays = GapOptions{}.rays;
};

// A plant, a canopy or a scene, told by name and content.
Scene read_structure(const std::string& path) {
  if (is_plant_file(path)) return plant_scene(path);
  if (path.ends_with(".ops")) return ops_scene(path);
  const TomlDocument document = TomlDocument::read(path);
  if (document.root().has("planting") || document.root().has("plants")) return canopy_scene(path);
  Scene scene = read_scene_geometry(document);
  if (scene.instances.empty())
    bad_input({path}, "no plants and no [[instances]]: there is no structure to describe");
  return scene;
}

Json gaps_json(const std::vector<Gap>& gaps) {
  Json out = Json::array();
  for (const Gap& gap : gaps)
    out.push_back({{"zenith_deg", gap.zenith_deg}, {"p", gap.p}, {"standard_error", gap.standard_error}});
  return out;
}

Json leaf_angle_json(const FacetStructure& facets) {
  Json bins = Json::array();
  for (const auto& bin : facets.leaf_angle)
    bins.push_back({{"from_deg", bin.from_deg},
                    {"to_deg", bin.to_deg},
                    {"probability", bin.probability},
                    {"density_per_deg", bin.density_per_deg}});
  return {{"mean_deg", bins.empty() ? Json(nullptr) : json_number(facets.mean_leaf_angle_deg)},
          {"bins", bins}};
}

Json organs_json(const Scene& scene) {
  Json out = Json::array();
  for (const Prototype& prototype : scene.prototypes) {
    if (!prototype.mesh) continue;
    for (std::size_t k = 0; k < prototype.mesh->organs.size(); ++k) {
      const Mesh::Organ& organ = prototype.mesh->organs[k];
      out.push_back({{"id", organ.id},
                     {"label", organ.label},
                     {"kind", organ.kind},
                     {"material", scene.materials[prototype.material_of_organ[k]]},
                     {"length_m", json_number(organ.length_m)},
                     {"area_m2", organ.area_m2},
                     {"plant", prototype.name}});
    }
  }
  return out;
}

Json describe(const Scene& scene, const CanopyStructure& structure) {
  Json g = Json::array(), clumping = Json::array(), materials = Json::object();
  for (const auto& point : structure.facets.g_function)
    g.push_back({{"zenith_deg", point.zenith_deg}, {"g", point.g}});
  for (const Clumping& c : structure.clumping)
    clumping.push_back(
        {{"zenith_deg", c.zenith_deg}, {"index", c.index}, {"standard_error", c.standard_error}});
  for (const auto& [name, area] : structure.material_area_m2) materials[name] = {{"area_m2", area}};
  const bool ground = structure.ground_area_m2 > 0;
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Gap down = structure.gaps.empty() ? Gap{0, none, none} : structure.gaps.front();
  return {{"leaf_area_m2", structure.facets.total_leaf_area_m2},
          {"ground_area_m2", ground ? Json(structure.ground_area_m2) : Json(nullptr)},
          {"ground_area_of", structure.ground_is_domain ? "domain" : "convex_hull"},
          {"lai", ground ? Json(structure.lai) : Json(nullptr)},
          {"height_m", structure.height_m},
          {"cover", json_number(1 - down.p)},
          {"cover_standard_error", json_number(down.standard_error)},
          {"gap_fraction", gaps_json(structure.gaps)},
          {"g_function", g},
          {"leaf_angle", leaf_angle_json(structure.facets)},
          {"materials", materials},
          {"organs", organs_json(scene)},
          {"clumping", clumping},
          {"instances", scene.instances.size()},
          {"notes", scene.notes}};
}

void run(const Cli& cli, const DescribeArguments& options) {
  const Scene scene = read_structure(options.file);
  for (const std::string& message : scene.notes) note(message);
  Provenance from = provenance(cli, true);
  from.add_input(options.file);
  for (const std::string& input : scene.inputs)
    if (input != options.file) from.add_input(input);
  const CanopyStructure structure = canopy_structure(scene, {options.rays, cli.common.seed});
  const Json report = describe(scene, structure);
  if (!cli.common.json) {
    fmt::print("leaf area   {:.6g} m2\n", structure.facets.total_leaf_area_m2);
    fmt::print("ground area {:.6g} m2 ({})\n", structure.ground_area_m2,
               structure.ground_is_domain ? "domain" : "convex hull of the plan view");
    fmt::print("LAI         {:.4g}\n", structure.lai);
    fmt::print("height      {:.4g} m\n", structure.height_m);
    fmt::print("mean leaf inclination {:.2f} degrees\n", structure.facets.mean_leaf_angle_deg);
    fmt::print("gap fraction at zenith:\n");
    for (const Gap& gap : structure.gaps)
      fmt::print("  {:5.1f}  {:.5f} +- {:.5f}\n", gap.zenith_deg, gap.p, gap.standard_error);
  }
  deliver_report(cli, "describe", report, from);
}

}  // namespace

void add_describe(Cli& cli) {
  auto options = std::make_shared<DescribeArguments>();
  CLI::App* verb = add_verb(cli, "describe", "structure of a plant, a canopy or a scene: areas, angles, gaps",
                            "bpms describe canopy.toml --json", [&cli, options] { run(cli, *options); });
  verb->add_option("file", options->file, "plant (.bpms), canopy.toml or scene.toml")->required();
  verb->add_option("--rays", options->rays, "rays for each zenith angle of the gap fraction (default 65536)")
      ->check(CLI::Range(32, 1 << 28));
}

}  // namespace bpms
