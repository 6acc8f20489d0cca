#include <fmt/core.h>

#include <cmath>
#include <filesystem>

#include "apps/bpms/verb.h"
#include "apps/bpms/verbs.h"
#include "core/atomic_file.h"
#include "core/interrupt.h"
#include "core/progress.h"
#include "core/units.h"
#include "simulate/output/derived.h"
#include "simulate/output/envi.h"
#include "simulate/output/output.h"
#include "simulate/output/romc_files.h"

namespace bpms {
namespace {

struct SimulateArguments {
  std::string scene;
  std::string csv;
  std::string target_se;
  std::uint64_t samples = 0;
  bool image_origins = false;
  bool keep_interactions = false;
  std::string envi, romc, diffuse_fraction, memory;
};

// A picture beside OUT.nc for each image: OUT.png, or OUT_SENSOR.png when there are several sensors.
std::string picture_path(const Cli& cli, const Simulation& simulation, std::size_t sensor) {
  std::filesystem::path path = cli.common.output;
  path.replace_filename(path.stem().string() +
                        (simulation.sensors.size() > 1 ? "_" + sensor_identifier(simulation, sensor) : "") +
                        ".png");
  return path.string();
}

void write_quick_looks(const Cli& cli, const Simulation& simulation, const Result& result) {
  for (std::size_t i = 0; i < result.sensors.size(); ++i) {
    if (!result.sensors[i].sensor->is_image()) continue;
    write_file(picture_path(cli, simulation, i), encode_png(quick_look(simulation, result.sensors[i])),
               cli.common.overwrite);
  }
}

std::vector<std::string> all_outputs(const Cli& cli, const SimulateArguments& options,
                                     const Simulation& simulation) {
  std::vector<std::string> out{cli.common.output, options.csv};
  for (std::size_t i = 0; i < simulation.sensors.size(); ++i)
    if (simulation.sensors[i]->is_image()) out.push_back(picture_path(cli, simulation, i));
  if (!options.envi.empty())
    for (std::size_t i = 0; i < simulation.sensors.size(); ++i)
      for (const bool errors : {false, true}) {
        out.push_back(envi_path(simulation, i, options.envi, errors));
        out.push_back(envi_header_path(out.back()));
      }
  if (!options.romc.empty())
    for (const RomcFile& file : romc_files(simulation, options.romc)) out.push_back(file.path);
  return out;
}

// A number, or the name of a file with a spectrum: read as a scene reads one.
std::vector<double> diffuse_fraction(const std::string& text, Simulation& simulation) {
  if (text.empty()) return {};
  if (simulation.light.suns.empty() || !simulation.light.sky)
    bad_input({"--diffuse-fraction"},
              "direct and diffuse light are recombined: expected a scene with sun and sky");
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const bool is_number = *end == '\0' && std::isfinite(number);
  const TomlDocument document = TomlDocument::parse(
      "--diffuse-fraction", "fraction = " + (is_number ? toml_number(number) : toml_string(text)));
  const std::vector<double> traced =
      read_spectrum(document.root().require("fraction"), simulation.bands, 0, 1, simulation.inputs);
  return simulation.bands.integrate(traced);
}

void write_envi(const Cli& cli, const std::string& prefix, const Simulation& simulation,
                const Result& result) {
  for (std::size_t i = 0; i < result.sensors.size(); ++i)
    for (const bool errors : {false, true}) {
      const EnviCube cube =
          envi_cube(simulation, result.sensors[i], errors, "bpms " + std::string(version()));
      const std::string path = envi_path(simulation, i, prefix, errors);
      // Neither is of use without the other: both are on the disk before either is in its place.
      AtomicFile pixels(path, cli.common.overwrite), header(envi_header_path(path), cli.common.overwrite);
      pixels.write(cube.pixels);
      header.write(cube.header);
      pixels.commit();
      header.commit();
    }
}

void write_romc(const Cli& cli, const std::string& experiment, const Simulation& simulation,
                const Result& result) {
  for (const RomcFile& file : romc_files(simulation, experiment))
    if (file.sensor < result.sensors.size())
      write_file(file.path, romc_text(simulation, result, file), cli.common.overwrite);
}

void note_enough_order(const Simulation& simulation, const Result& result) {
  int enough = 0;
  for (const SensorResult& sensor : result.sensors)
    for (const OrderDecay& decay : order_decay(simulation, sensor)) {
      if (!decay.enough_order) return;
      enough = std::max(enough, *decay.enough_order);
    }
  if (enough > 0 && simulation.sampling.max_order == 0)
    note(fmt::format("max_order = {} would be enough: higher orders add less than the standard error",
                     enough));
}

void run(const Cli& cli, const SimulateArguments& options) {
  const std::string& output = require_output(cli);
  Simulation simulation = read_simulation(options.scene);
  require_outputs(cli, all_outputs(cli, options, simulation));
  if (!options.target_se.empty()) set_target_se(simulation.sampling, options.target_se, {"--target-se"});
  if (options.samples > 0) {
    simulation.sampling.samples = options.samples;
    simulation.sampling.target_se = 0;
  }
  if (!options.memory.empty()) simulation.most_bytes = parse_bytes(options.memory, {"--memory"});
  simulation.sampling.keep_interactions = options.keep_interactions;
  for (const std::string& line : simulation.scene.notes) note(line);
  const std::vector<double> fraction = diffuse_fraction(options.diffuse_fraction, simulation);
  Provenance from = provenance(cli, true);
  if (simulation.inputs.empty() || simulation.inputs.front() != options.scene) from.add_input(options.scene);
  for (const std::string& input : simulation.inputs) from.add_input(input);

  Result result = simulate(simulation, cli.common.seed);
  result.diffuse_fraction = fraction;
  write_netcdf(simulation, result, from, output, {cli.common.overwrite, options.image_origins});
  if (!options.csv.empty()) write_file(options.csv, result_csv(simulation, result), cli.common.overwrite);
  write_quick_looks(cli, simulation, result);
  if (!options.envi.empty()) write_envi(cli, options.envi, simulation, result);
  if (!options.romc.empty()) write_romc(cli, options.romc, simulation, result);
  deliver_report(cli, "simulate", result_report(simulation, result), from);
  note(fmt::format("{} paths, {} rays in {:.1f} s; stopped by {}", result.samples, result.rays,
                   result.seconds, result.stopped_by));
  note_enough_order(simulation, result);
  if (result.stopped_by == "interrupt")
    throw Error(ErrorKind::interrupted,
                fmt::format("interrupted; {} holds what was done, marked stopped_by = interrupt", output));
}

}  // namespace

void add_simulate(Cli& cli) {
  auto options = std::make_shared<SimulateArguments>();
  CLI::App* verb = add_verb(
      cli, "simulate", "trace light through a scene to its sensors: radiance, reflectance and their parts",
      "bpms simulate scene.toml -o out.nc --csv out.csv --report out.html",
      [&cli, options] { run(cli, *options); });
  verb->add_option("scene", options->scene, "scene.toml")->required();
  verb->add_option("--csv", options->csv, "the results as a tidy table");
  verb->add_option("--samples", options->samples,
                   "paths per view or pixel, instead of what the scene says (rounded up to 32 x 2^k)")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{100'000'000'000}));
  verb->add_option("--target-se", options->target_se, "standard error of each view's total: 0.0002 or 0.1%")
      ->excludes("--samples");
  verb->add_option("--memory", options->memory,
                   "refuse what needs more for the traced scene and the results: 4GiB");
  verb->add_option("--envi", options->envi,
                   "image cubes with headers as ENVI reads them: PREFIX_SENSOR.img, or FOLDER/");
  verb->add_option(
      "--romc", options->romc,
      "files of the RAMI On-line Model Checker: EXPERIMENT makes brfpp_bpms-EXPERIMENT.mes and so on");
  verb->add_option("--diffuse-fraction", options->diffuse_fraction,
                   "reflectance at this diffuse fraction of the irradiance too: 0.2, or a spectrum's file");
  verb->add_flag("--image-origins", options->image_origins,
                 "keep the pixels of images by origin of the light too: total, direct, diffuse");
  verb->add_flag("--keep-interactions", options->keep_interactions,
                 "keep the histogram of interactions, for bpms recolour");
}

}  // namespace bpms
