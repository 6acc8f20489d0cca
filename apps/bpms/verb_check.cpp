#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <vector>

#include "apps/bpms/file_kinds.h"
#include "apps/bpms/verb.h"
#include "apps/bpms/verbs.h"
#include "calibrate/rig.h"
#include "calibrate/targets/target_kind.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "core/progress.h"
#include "core/records.h"
#include "core/text.h"
#include "plant/canopy.h"
#include "plant/plant.h"
#include "plant/plant_file.h"
#include "plant/plant_format.h"
#include "plant/plant_library.h"
#include "simulate/simulate.h"

namespace bpms {
namespace {

bool first_line_has(std::string_view text, std::string_view word) {
  return text.substr(0, text.find('\n')).find(word) != std::string_view::npos;
}

std::string check_plant(const std::string& path) {
  if (const auto library = parse_plant_library(path, read_text(path)))
    return fmt::format("a library: {} constants, {} organs, {} blocks", library->constants.size(),
                       library->organs.size(), library->blocks);
  const Plant plant = read_plant(path);
  for (const std::string& warning : plant.warnings) note(warning);
  return fmt::format("{} organs, {} blocks, {} notes", place_organs(plant).size(), plant.blocks.size(),
                     plant.warnings.size());
}

std::string check_canopy(const std::string& path) {
  const Canopy canopy = read_canopy(path);
  for (const std::string& text : canopy.notes) note(text);
  return fmt::format("{} plants from {} plant files", canopy.placements.size(), canopy.plants.size());
}

std::string check_scene(const std::string& path) {
  const Simulation simulation = read_simulation(path);
  for (const std::string& text : simulation.scene.notes) note(text);
  std::size_t views = 0;
  for (const auto& sensor : simulation.sensors) views += sensor->views();
  return fmt::format("{} instances of {} prototypes, {} materials, {} sensors, {} views, {} bands",
                     simulation.scene.instances.size(), simulation.scene.prototypes.size(),
                     simulation.materials.size(), simulation.sensors.size(), views,
                     simulation.bands.written());
}

const std::vector<FileKind>& kinds() {
  static const std::vector<FileKind> table{
      {"points.csv", [](const std::string&, std::string_view text) { return first_line_has(text, "u_px"); },
       [](const std::string& path) {
         return fmt::format("{} image points", read_image_points(path).size());
       }},
      {"vectors.csv", [](const std::string&, std::string_view text) { return first_line_has(text, "x_m"); },
       [](const std::string& path) { return fmt::format("{} vectors", read_vectors(path).size()); }},
      {"plant.bpms", [](const std::string& path, std::string_view) { return path.ends_with(".bpms"); },
       check_plant},
      {"plant of another program",
       [](const std::string& path, std::string_view) { return is_plant_file(path); },
       [](const std::string& path) {
         PlantFileOptions reading;
         reading.topology_alone = true;
         const PlantFile plant = read_plant_file(path, reading);
         for (const std::string& text : plant.notes) note(text);
         return fmt::format("{} organs, {} entities", plant.mesh.organs.size(), plant.mtg.vertices.size());
       }},
      {"stand.ops", [](const std::string& path, std::string_view) { return path.ends_with(".ops"); },
       [](const std::string& path) { return fmt::format("{} plants", read_ops(path).rows.size()); }},
      {"canopy.toml",
       [](const std::string& path, std::string_view text) {
         return path.ends_with(".toml") && (text.find("[planting]") != std::string_view::npos ||
                                            text.find("[[plants]]") != std::string_view::npos);
       },
       check_canopy},
      {"rig.toml",
       [](const std::string&, std::string_view text) {
         return text.find("[[cameras]]") != std::string_view::npos;
       },
       [](const std::string& path) { return fmt::format("{} cameras", read_rig(path).cameras.size()); }},
      {"target",
       [](const std::string& path, std::string_view text) {
         if (path.ends_with(".yaml") || path.ends_with(".yml"))
           return text.find("target_type") != std::string_view::npos ||
                  text.find("tag_bundles") != std::string_view::npos;
         const std::vector<std::string> names = target_kind_names();
         return path.ends_with(".toml") &&
                std::any_of(names.begin(), names.end(), [&](const std::string& name) {
                  return text.find("kind = \"" + name + "\"") != std::string_view::npos;
                });
       },
       [](const std::string& path) {
         const Target target = read_board(path);
         return fmt::format("{}, {} points", target.kind, target.size());
       }},
      {"scene.toml",
       [](const std::string& path, std::string_view text) {
         if (!path.ends_with(".toml")) return false;
         for (const char* word :
              {"[illumination]", "[[sensors]]", "[sampling]", "[materials.", "[prototypes."})
           if (text.find(word) != std::string_view::npos) return true;
         return false;
       },
       check_scene},
  };
  return table;
}

// Plants that read without an error, laid out anew: the one on stdout, or all of them in place.
void format_plants(const Cli& cli, const std::vector<std::string>& files) {
  if (files.size() > 1 && !cli.common.overwrite)
    bad_input({}, "--format prints one file; give --overwrite to rewrite {} files in place", files.size());
  Json results = Json::array();
  for (const std::string& path : files) {
    if (!path.ends_with(".bpms")) bad_input({path}, "--format is for plants (.bpms)");
    check_plant(path);
    const std::string text = read_text(path);
    const std::string formatted = formatted_plant(path, text);
    const bool changed = formatted != text;
    results.push_back({{"file", path}, {"changed", changed}});
    if (!cli.common.overwrite) {
      if (!cli.common.json) fmt::print("{}", formatted);
      continue;
    }
    if (changed) write_file(path, formatted, true);
    if (!cli.common.json) fmt::print("{}: {}\n", path, changed ? "formatted" : "unchanged");
  }
  deliver_report(cli, "check", {{"files", results}}, provenance(cli));
}

void run(const Cli& cli, const std::vector<std::string>& files) {
  Json results = Json::array();
  for (const std::string& path : files) {
    const std::string text = read_text(path);
    const FileKind* found = nullptr;
    for (const FileKind& kind : kinds()) {
      if (found == nullptr && kind.recognise(path, text)) found = &kind;
    }
    if (found == nullptr) bad_input({path}, "not recognised as any kind of file that bpms reads");
    const std::string summary = found->check(path);
    results.push_back({{"file", path}, {"kind", found->name}, {"summary", summary}});
    if (!cli.common.json) fmt::print("{}: {}: {}\n", path, found->name, summary);
  }
  deliver_report(cli, "check", {{"files", results}}, provenance(cli));
}

}  // namespace

void add_check(Cli& cli) {
  auto files = std::make_shared<std::vector<std::string>>();
  auto format = std::make_shared<bool>(false);
  CLI::App* verb = add_verb(
      cli, "check", "validate any file that bpms reads", "bpms check wheat.bpms scene.toml vectors.csv",
      [&cli, files, format] { *format ? format_plants(cli, *files) : run(cli, *files); });
  verb->add_option("files", *files, "files of any kind")->required();
  verb->add_flag("--format", *format,
                 "print a plant evenly laid out; with --overwrite rewrite plants in place");
}

}  // namespace bpms
