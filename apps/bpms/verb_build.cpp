#include <fmt/core.h>

#include <cmath>

#include "apps/bpms/build_exchange.h"
#include "apps/bpms/verb.h"
#include "apps/bpms/verbs.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "core/progress.h"
#include "core/units.h"
#include "plant/leaf_patches.h"
#include "plant/mesh_file.h"
#include "plant/mesh_levels.h"
#include "plant/mesh_mass.h"
#include "plant/mesh_quality.h"
#include "plant/plant_mesh.h"
#include "plant/structure/orientation.h"

namespace bpms {
namespace {

struct BuildArguments {
  std::string plant;
  std::vector<std::string> also;  // further outputs
  std::string tolerance = "0.1mm";
  bool lenient = false;
  ExchangeArguments exchange;
  int levels = 1;
  bool crossings = false;  // between organs
};

// Levels of detail beyond the first have its name with _lod1, _lod2, ... before the ending.
std::string level_path(const std::string& path, int level) {
  if (level == 0) return path;
  const std::size_t dot = path.rfind('.');
  return fmt::format("{}_lod{}{}", path.substr(0, dot), level, path.substr(dot));
}

bool is_patch_file(const std::string& path) {
  return path.ends_with(".bpt");
}

double tolerance_m(const std::string& text) {
  constexpr double least_m = 1e-7, most_m = 1;
  const double out = parse_length(text, {});
  if (!(out >= least_m && out <= most_m))
    bad_input({}, "--tolerance {}: expected a length from 0.0001mm to 1m", in_quotes(text));
  return out;
}

// Coarse enough for a page, rounded so that the text stays short.
Json mesh_json(const Mesh& mesh) {
  constexpr double steps_per_metre = 1e5;
  Json positions = Json::array(), indices = Json::array();
  for (const Eigen::Vector3f& p : mesh.positions_m) {
    for (const float value : p)
      positions.push_back(std::round(static_cast<double>(value) * steps_per_metre) / steps_per_metre);
  }
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) indices.push_back(vertex);
  }
  Json organs = Json::array();
  for (const std::uint32_t organ : mesh.organ_of_triangle) organs.push_back(mesh.organs[organ].id);
  return {{"positions", positions}, {"indices", indices}, {"organ_ids", organs}};
}

Json quality_json(const Mesh& mesh, bool between_organs) {
  MeshQualityOptions options;
  options.between_organs = between_organs;
  const MeshQuality quality = mesh_quality(mesh, options);
  Json crossings = Json::array();
  for (const MeshCrossing& crossing : quality.crossings)
    crossings.push_back({{"organ", mesh.organs[crossing.organ].label},
                         {"other", mesh.organs[crossing.other].label},
                         {"triangle_pairs", crossing.pairs},
                         {"l", crossing.l},
                         {"at_m", {crossing.at_m.x(), crossing.at_m.y(), crossing.at_m.z()}}});
  return {{"smallest_angle_deg", quality.smallest_angle_deg},
          {"largest_aspect", quality.largest_aspect},
          {"slivers", quality.slivers},
          {"degenerate_triangles", quality.degenerate},
          {"duplicate_faces", quality.duplicate_faces},
          {"non_manifold_edges", quality.non_manifold_edges},
          {"crossings", crossings}};
}

Json levels_json(const std::vector<MeshLevel>& levels) {
  Json out = Json::array();
  for (const MeshLevel& level : levels) {
    FacetOrientation leaves;
    for (std::size_t t = 0; t < level.mesh.triangles.size(); ++t)
      if (level.mesh.organs[level.mesh.organ_of_triangle[t]].kind == "leaf")
        leaves.add(triangle_area_vector(level.mesh, t));
    out.push_back(
        {{"tolerance_m", level.tolerance_m},
         {"triangles", level.mesh.triangles.size()},
         {"deviation_m", level.deviation_m},
         {"leaf_area_m2", leaves.area()},
         {"mean_leaf_angle_deg", leaves.empty() ? Json() : Json(degrees(leaves.mean_inclination()))}});
  }
  return out;
}

Json report(const Plant& plant, const Mesh& mesh, const std::vector<std::string>& files, double tolerance) {
  Json organs = Json::array();
  double leaf_area = 0, area = 0;
  for (const Mesh::Organ& organ : mesh.organs) {
    organs.push_back({{"id", organ.id},
                      {"label", organ.label},
                      {"kind", organ.kind},
                      {"material", organ.material},
                      {"length_m", organ.length_m},
                      {"area_m2", organ.area_m2},
                      {"volume_m3", organ.volume_m3},
                      {"centroid_m", {organ.centroid_m.x(), organ.centroid_m.y(), organ.centroid_m.z()}}});
    area += organ.area_m2;
    if (organ.kind == "leaf") leaf_area += organ.area_m2;
  }
  constexpr double page_tolerance_m = 5e-4;
  const OrganMass mass = plant_mass(mesh);
  Json out{{"plant", plant.name},
           {"tolerance_m", tolerance},
           {"area_m2", area},
           {"leaf_area_m2", leaf_area},
           {"volume_m3", mass.volume_m3},
           {"centroid_m", {mass.centroid_m.x(), mass.centroid_m.y(), mass.centroid_m.z()}},
           {"triangles", mesh.triangles.size()},
           {"vertices", mesh.positions_m.size()},
           {"files", files},
           {"organs", organs},
           {"notes", plant.warnings}};
  out["mesh"] = mesh_json(tolerance >= page_tolerance_m ? mesh : plant_mesh(plant, {page_tolerance_m}));
  return out;
}

void run(const Cli& cli, const BuildArguments& options) {
  std::vector<std::string> outputs{require_output(cli)};
  outputs.insert(outputs.end(), options.also.begin(), options.also.end());
  const double tolerance = tolerance_m(options.tolerance);
  if (build_exchange(cli, {options.plant, outputs, tolerance, options.lenient}, options.exchange)) return;
  std::vector<std::string> files;
  for (const std::string& output : outputs) {
    if (is_patch_file(output)) {
      files.push_back(output);
      continue;
    }
    for (int level = 0; level < options.levels; ++level)
      for (const std::string& path : mesh_file_paths(level_path(output, level))) files.push_back(path);
  }
  require_outputs(cli, files);
  Provenance made_from = provenance(cli);
  const Plant plant = read_plant(options.plant, {options.lenient});
  for (const std::string& input : plant.inputs) made_from.add_input(input);
  for (const std::string& warning : plant.warnings) note(warning);
  const std::vector<MeshLevel> levels = mesh_levels(plant, {tolerance}, options.levels);
  const auto write = [&](const std::string& path, const std::string& bytes) {
    write_file(path, bytes, cli.common.overwrite);
  };
  for (const std::string& output : outputs) {
    if (is_patch_file(output)) {
      write(output, patch_file_text(plant_patches(plant, tolerance)));
      continue;
    }
    for (int level = 0; level < options.levels; ++level)
      for (const MeshFile& file :
           mesh_files(level_path(output, level), levels[static_cast<std::size_t>(level)].mesh))
        write(file.path, file.bytes);
  }
  if (!cli.common.json && cli.common.report.empty()) return;
  const Mesh& mesh = levels.front().mesh;
  Json out = report(plant, mesh, files, tolerance);
  out["quality"] = quality_json(mesh, options.crossings);
  if (options.levels > 1) out["levels"] = levels_json(levels);
  deliver_report(cli, "build", out, made_from);
}

}  // namespace

void add_build(Cli& cli) {
  auto options = std::make_shared<BuildArguments>();
  CLI::App* verb = add_verb(
      cli, "build", "geometry of a plant or a stand: PLY, OBJ, GLB, patches (.bpt); MTG, OPF, OPS",
      "bpms build wheat.bpms -o wheat.ply --also wheat.glb", [&cli, options] { run(cli, *options); });
  verb->add_option("plant", options->plant,
                   "plant (.bpms, .mtg, .opf, .lsys, .lstr) or stand (canopy.toml, .ops)")
      ->required();
  add_exchange_options(verb, options->exchange);
  verb->add_option("--also", options->also, "further outputs, each of a kind told by its name");
  verb->add_option("--tolerance", options->tolerance,
                   "largest distance between triangles and surface (default 0.1mm)");
  verb->add_option("--lod", options->levels,
                   "how many levels of detail, each of four times the tolerance: NAME, NAME_lod1, ...")
      ->check(CLI::Range(1, 8));
  verb->add_flag("--crossings", options->crossings, "report also which organs cross each other");
  verb->add_flag("--lenient", options->lenient, "close brackets that the word leaves open, and say so");
}

}  // namespace bpms
