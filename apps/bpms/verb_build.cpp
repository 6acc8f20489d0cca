#include <fmt/core.h>

#include <cmath>

#include "apps/bpms/verb.h"
#include "apps/bpms/verbs.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "core/progress.h"
#include "core/units.h"
#include "plant/mesh_file.h"
#include "plant/plant_mesh.h"

namespace bpms {
namespace {

struct BuildArguments {
  std::string plant;
  std::vector<std::string> also;  // further outputs
  std::string tolerance = "0.1mm";
  bool lenient = false;
};

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

Json report(const Plant& plant, const Mesh& mesh, const std::vector<std::string>& files, double tolerance) {
  Json organs = Json::array();
  double leaf_area = 0, area = 0;
  for (const Mesh::Organ& organ : mesh.organs) {
    organs.push_back({{"id", organ.id},
                      {"label", organ.label},
                      {"kind", organ.kind},
                      {"material", organ.material},
                      {"length_m", organ.length_m},
                      {"area_m2", organ.area_m2}});
    area += organ.area_m2;
    if (organ.kind == "leaf") leaf_area += organ.area_m2;
  }
  constexpr double page_tolerance_m = 5e-4;
  Json out{{"plant", plant.name},
           {"tolerance_m", tolerance},
           {"area_m2", area},
           {"leaf_area_m2", leaf_area},
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
  std::vector<std::string> files;
  for (const std::string& output : outputs) {
    for (const std::string& path : mesh_file_paths(output)) files.push_back(path);
  }
  require_outputs(cli, files);
  Provenance made_from = provenance(cli);
  const Plant plant = read_plant(options.plant, {options.lenient});
  for (const std::string& input : plant.inputs) made_from.add_input(input);
  for (const std::string& warning : plant.warnings) note(warning);
  const Mesh mesh = plant_mesh(plant, {tolerance});
  for (const std::string& output : outputs) {
    for (const MeshFile& file : mesh_files(output, mesh))
      write_file(file.path, file.bytes, cli.common.overwrite);
  }
  if (cli.common.json || !cli.common.report.empty())
    deliver_report(cli, "build", report(plant, mesh, files, tolerance), made_from);
}

}  // namespace

void add_build(Cli& cli) {
  auto options = std::make_shared<BuildArguments>();
  CLI::App* verb = add_verb(cli, "build", "geometry of a plant: PLY, OBJ or GLB",
                            "bpms build wheat.bpms -o wheat.ply --also wheat.glb",
                            [&cli, options] { run(cli, *options); });
  verb->add_option("plant", options->plant, "plant file (.bpms)")->required();
  verb->add_option("--also", options->also, "further outputs, each of a kind told by its name");
  verb->add_option("--tolerance", options->tolerance,
                   "largest distance between triangles and surface (default 0.1mm)");
  verb->add_flag("--lenient", options->lenient, "close brackets that the word leaves open, and say so");
}

}  // namespace bpms
