#include "apps/bpms/build_exchange.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/progress.h"
#include "core/units.h"
#include "plant/plant_file.h"
#include "plant/stand_file.h"

namespace bpms {
namespace {

bool has_extension(const std::string& path, std::initializer_list<const char*> extensions) {
  return std::any_of(extensions.begin(), extensions.end(),
                     [&](const char* one) { return path.ends_with(one); });
}

PlantFileOptions plant_options(const ExchangeBuild& build, const ExchangeArguments& options) {
  PlantFileOptions out;
  out.tolerance_m = build.tolerance_m;
  out.lenient = build.lenient;
  out.steps = options.steps;
  out.mtg.metres_per_unit = out.opf.metres_per_unit = metres_per_unit(options.unit, {"--unit"});
  out.mtg.metres_per_diameter_unit = out.mtg.metres_per_unit;
  if (!options.diameter_unit.empty())  // "0.1mm" as well as "mm"
    out.mtg.metres_per_diameter_unit = parse_length(
        std::isdigit(static_cast<unsigned char>(options.diameter_unit[0])) != 0 ? options.diameter_unit
                                                                                : "1" + options.diameter_unit,
        {"--diameter-unit"});
  return out;
}

Json organ_rows(const Mesh& mesh) {
  Json out = Json::array();
  for (const Mesh::Organ& organ : mesh.organs)
    out.push_back({{"id", organ.id},
                   {"label", organ.label},
                   {"kind", organ.kind},
                   {"material", organ.material},
                   {"length_m", organ.length_m},
                   {"area_m2", organ.area_m2}});
  return out;
}

void build_plant(const Cli& cli, const ExchangeBuild& build, const ExchangeArguments& options) {
  std::vector<std::string> files;
  for (const std::string& output : build.outputs)
    for (const std::string& path : plant_file_paths(output)) files.push_back(path);
  require_outputs(cli, files);
  PlantFileOptions reading = plant_options(build, options);
  reading.topology_alone = std::all_of(build.outputs.begin(), build.outputs.end(),
                                       [](const std::string& path) { return has_extension(path, {".mtg"}); });
  const PlantFile plant = read_plant_file(build.input, reading);
  for (const std::string& text : plant.notes) note(text);
  for (const std::string& output : build.outputs)
    for (const MeshFile& file : plant_files(output, plant))
      write_file(file.path, file.bytes, cli.common.overwrite);
  if (!cli.common.json && cli.common.report.empty()) return;
  Provenance from = provenance(cli);
  for (const std::string& input : plant.inputs) from.add_input(input);
  double area = 0, leaf_area = 0;
  for (const Mesh::Organ& organ : plant.mesh.organs) {
    area += organ.area_m2;
    if (organ.kind == "leaf") leaf_area += organ.area_m2;
  }
  deliver_report(cli, "build",
                 {{"plant", plant.name},
                  {"tolerance_m", build.tolerance_m},
                  {"area_m2", area},
                  {"leaf_area_m2", leaf_area},
                  {"triangles", plant.mesh.triangles.size()},
                  {"vertices", plant.mesh.positions_m.size()},
                  {"entities", plant.mtg.vertices.size()},
                  {"files", files},
                  {"organs", organ_rows(plant.mesh)},
                  {"notes", plant.notes}},
                 from);
}

void build_stand(const Cli& cli, const ExchangeBuild& build, const ExchangeArguments& options) {
  std::vector<std::string> files;
  for (const std::string& output : build.outputs)
    for (const std::string& path : stand_file_paths(output)) files.push_back(path);
  require_outputs(cli, files);
  std::vector<std::string> notes, inputs{build.input};
  Stand stand;
  if (has_extension(build.input, {".ops"})) {
    stand = ops_stand(build.input, [&](const std::string& file) {
      PlantFile plant = read_plant_file(file, plant_options(build, options));
      notes.insert(notes.end(), plant.notes.begin(), plant.notes.end());
      inputs.insert(inputs.end(), plant.inputs.begin(), plant.inputs.end());
      return std::make_shared<const Mesh>(std::move(plant.mesh));
    });
  } else {
    const Canopy canopy = read_canopy(build.input);
    notes = canopy.notes;
    inputs = canopy.inputs;
    stand = canopy_stand(canopy, build.tolerance_m);
  }
  for (const std::string& text : notes) note(text);
  for (const std::string& output : build.outputs) write_stand(output, stand, {cli.common.overwrite});
  if (!cli.common.json && cli.common.report.empty()) return;
  Provenance from = provenance(cli);
  for (const std::string& input : inputs) from.add_input(input);
  std::size_t triangles = 0;
  for (const StandItem& item : stand.items) triangles += stand.meshes[item.mesh]->triangles.size();
  deliver_report(cli, "build",
                 {{"stand", build.input},
                  {"kinds", stand.names},
                  {"plants", stand.items.size()},
                  {"triangles", triangles},
                  {"files", files},
                  {"notes", notes}},
                 from);
}

}  // namespace

void add_exchange_options(CLI::App* verb, ExchangeArguments& options) {
  verb->add_option("--unit", options.unit, "of lengths in MTG and OPF files (default cm)");
  verb->add_option("--diameter-unit", options.diameter_unit,
                   "of diameters in MTG files, like 0.1mm (default: that of lengths)");
  verb->add_option("--steps", options.steps, "of an L-system, instead of its own")
      ->check(CLI::Range(0, 10'000));
}

bool build_exchange(const Cli& cli, const ExchangeBuild& build, const ExchangeArguments& options) {
  if (has_extension(build.input, {".toml", ".ops"})) {
    build_stand(cli, build, options);
    return true;
  }
  const bool meshes = std::none_of(build.outputs.begin(), build.outputs.end(), [](const std::string& path) {
    return has_extension(path, {".mtg", ".opf", ".lstr"});
  });
  if (meshes && (build.input.ends_with(".bpms") || !is_plant_file(build.input))) return false;
  build_plant(cli, build, options);
  return true;
}

}  // namespace bpms
