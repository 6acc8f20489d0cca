#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "apps/bpms/verb.h"
#include "apps/bpms/verbs.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "core/progress.h"
#include "core/units.h"
#include "fit/fit.h"
#include "fit/plant_assembly.h"
#include "fit/polyline_table.h"
#include "fit/report.h"

namespace bpms {
namespace {

struct FitArguments {
  std::string input, function = "auto", columns, unit, dialect, width, bases = "common";
  bool anchor_base = false;
};

struct Measured {
  std::vector<MeasuredOrgan> organs;
  std::map<std::string, Eigen::Vector3d> buds;  // of the plants that have one
};

Measured read_organs(const FitArguments& arguments) {
  if (!arguments.columns.empty()) {
    const PolylineColumns columns = parse_polyline_columns(arguments.columns);
    if (arguments.unit.empty())
      bad_input({}, "--columns needs --unit: the unit of the coordinates (m, cm, mm, ...)");
    return {read_polylines(arguments.input, columns, metres_per_unit(arguments.unit, {}),
                           csv_dialect(arguments.dialect.empty() ? "en" : arguments.dialect)),
            {}};
  }
  if (!arguments.unit.empty()) bad_input({}, "--unit goes with --columns; vectors.csv is in metres");
  if (!arguments.dialect.empty())
    bad_input({}, "--dialect goes with --columns; vectors.csv has commas and points");
  const std::vector<VectorPoint> points = read_vectors(arguments.input);
  std::vector<std::string> notes;
  Measured out{group_organs(points, notes), {}};
  for (const std::string& line : notes) note(line);
  if (out.organs.empty()) bad_input({arguments.input}, "no leaf, stem or head among the vectors");
  for (const MeasuredOrgan& organ : out.organs) {
    if (const auto bud = bud_of_plant(points, organ.plant)) out.buds[organ.plant] = *bud;
  }
  return out;
}

// A plant's name made safe for a file: letters, digits, - _ . stay.
std::string file_stem(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const bool safe = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '-' || c == '_' || (c == '.' && !out.empty());
    out += safe ? c : '_';
  }
  return out.empty() ? "plant" : out;
}

// Where each plant goes: one to the output itself, unless that names a folder; several to files in the
// folder.
std::map<std::string, std::string> plant_files(const std::string& output,
                                               const std::vector<std::string>& names) {
  std::map<std::string, std::string> out;
  if (names.size() == 1 && !names_folder(output)) return {{names[0], output}};
  if (output.ends_with(".bpms"))
    bad_input({}, "the input holds {} plants: give a folder, -o plants/", names.size());
  std::set<std::string> used;
  for (const std::string& name : names) {
    std::string stem = file_stem(name);
    for (int k = 2; !used.insert(stem).second; ++k) stem = fmt::format("{}_{}", file_stem(name), k);
    out[name] = (std::filesystem::path(output) / (stem + ".bpms")).string();
  }
  return out;
}

// Refused before the fitting; a folder that is there already may hold other files.
void require_plant_files(const Cli& cli, const std::map<std::string, std::string>& files) {
  const std::filesystem::path output = cli.common.output;
  if (files.begin()->second == cli.common.output || std::filesystem::is_directory(output)) {
    std::vector<std::string> paths;
    for (const auto& [name, path] : files) paths.push_back(path);
    require_outputs(cli, paths);
  } else {  // the folder will be made
    const std::string folder = output.has_filename() ? output.string() : output.parent_path().string();
    require_writable(folder, false);
    require_outputs(cli, {});
  }
}

void write_plants(const Cli& cli, const std::map<std::string, std::string>& files,
                  const std::vector<FittedPlant>& plants) {
  const std::string& output = cli.common.output;
  if (files.begin()->second != output) {
    std::error_code code;
    std::filesystem::create_directories(output, code);
    if (code)
      throw Error(ErrorKind::missing_resource, {output}, "the folder cannot be made: " + code.message());
  }
  for (const FittedPlant& plant : plants)
    write_file(files.at(plant.plant.name), plant_text(plant.plant), cli.common.overwrite);
}

void run(const Cli& cli, const FitArguments& arguments) {
  const std::string& output = require_output(cli);
  FitOptions options;
  options.functions = parse_function_request(arguments.function);
  options.anchor_base = arguments.anchor_base;
  AssemblyOptions assembly;
  if (arguments.bases != "common" && arguments.bases != "measured")
    bad_input({}, "found --bases {}, expected common or measured", in_quotes(arguments.bases));
  assembly.measured_bases = arguments.bases == "measured";
  if (!arguments.width.empty()) {
    assembly.width_m = parse_length(arguments.width, {});
    if (!(assembly.width_m > 0))
      bad_input({}, "--width {}: expected a length above 0", in_quotes(arguments.width));
  }
  const Measured measured = read_organs(arguments);
  const std::vector<MeasuredOrgan>& organs = measured.organs;

  std::vector<std::string> names;  // plants in order of appearance
  std::map<std::string, std::vector<std::size_t>> members;
  for (std::size_t k = 0; k < organs.size(); ++k) {
    if (!members.contains(organs[k].plant)) names.push_back(organs[k].plant);
    members[organs[k].plant].push_back(k);
  }
  const std::map<std::string, std::string> files = plant_files(output, names);
  require_plant_files(cli, files);

  const std::vector<OrganFit> fits = fit_organs(organs, options);
  for (const OrganFit& fit : fits) {
    if (!fit.ok()) note(fmt::format("{}: not fitted: {}", fit.measured.str(), fit.failure));
    for (const std::string& line : fit.notes) note(fmt::format("{}: {}", fit.measured.str(), line));
  }
  const auto bare = std::count_if(fits.begin(), fits.end(), [&](const OrganFit& fit) {
    return fit.ok() && fit.measured.organ == "leaf" && !fit.functions.contains("width") &&
           assembly.width_m <= 0;
  });
  if (bare > 0)
    note(fmt::format("{} leaves have no measured edges, so no width and no surface (give --width 1.2cm)",
                     bare));
  std::vector<FittedPlant> plants;
  for (const std::string& name : names) {
    const auto bud = measured.buds.find(name);
    assembly.bud_m = bud == measured.buds.end() ? std::nullopt : std::optional(bud->second);
    FittedPlant plant = assemble_plant(name, fits, members[name], assembly);
    if (!plant.organs.empty()) plants.push_back(std::move(plant));
  }
  if (plants.empty())
    bad_input({arguments.input}, "none of the {} organs could be fitted; the first, {}: {}", fits.size(),
              fits[0].measured.str(), fits[0].failure);
  write_plants(cli, files, plants);
  if (cli.common.json || !cli.common.report.empty()) {
    Json report = fit_report(fits, plants);
    report["input"] = arguments.input;
    report["function"] = arguments.function;
    Provenance source = provenance(cli);
    source.add_input(arguments.input);
    deliver_report(cli, "fit", std::move(report), source);
  }
  const Json summary = fit_summary(fits);
  note(fmt::format("{} of {} organs fitted; rms in parts of the length: median {:.3g} %",
                   fits.size() - summary["failed"].get<std::size_t>(), fits.size(),
                   100 * summary["rms_fraction_median"].get<double>()));
}

}  // namespace

void add_fit(Cli& cli) {
  auto arguments = std::make_shared<FitArguments>();
  CLI::App* verb = add_verb(
      cli, "fit", "organ functions from measured polylines: a plant",
      "bpms fit vectors.csv -o plant.bpms --report fit.json\n"
      "  bpms fit leaves.csv --columns \"leaf=variety+inerv,x=x,z=y\" --unit cm "
      "--function p:3 -o leaves.bpms",
      [&cli, arguments] { run(cli, *arguments); }, OutputKind::file_or_folder);
  verb->add_option("vectors", arguments->input, "vectors.csv, or a table of polylines with --columns")
      ->required();
  verb->add_option(
      "--function", arguments->function,
      "auto, n:KNOTS, p:DEGREE, f:HARMONICS, s:KNOTS for all functions, or NAME=CHOICE,... (default auto)");
  verb->add_option(
      "--columns", arguments->columns,
      "what the columns mean: leaf=A+B,x=X,z=Z[,y=,plant=,axis=,rank=,organ=,feature=,point=,sigma=]");
  verb->add_option("--unit", arguments->unit, "unit of the coordinates with --columns: m, cm, mm, ...");
  verb->add_option("--dialect", arguments->dialect,
                   "with --columns: en (comma, point) or fr (semicolon, decimal comma)");
  verb->add_option("--width", arguments->width,
                   "full width of leaves whose edges were not measured, as 1.2cm");
  verb->add_option("--bases", arguments->bases,
                   "common: all organs start at one point (default); measured: where they were measured, "
                   "behind stems without surface");
  verb->add_flag("--anchor-base", arguments->anchor_base, "midribs start exactly at their first point");
}

}  // namespace bpms
