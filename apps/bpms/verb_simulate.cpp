#include <fmt/core.h>

#include <filesystem>

#include "apps/bpms/verb.h"
#include "apps/bpms/verbs.h"
#include "core/atomic_file.h"
#include "core/interrupt.h"
#include "core/progress.h"
#include "simulate/output/output.h"

namespace bpms {
namespace {

struct SimulateArguments {
  std::string scene;
  std::string csv;
  std::string target_se;
  std::uint64_t samples = 0;
  bool image_origins = false;
  bool keep_interactions = false;
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
  return out;
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
  simulation.sampling.keep_interactions = options.keep_interactions;
  for (const std::string& line : simulation.scene.notes) note(line);
  Provenance from = provenance(cli, true);
  if (simulation.inputs.empty() || simulation.inputs.front() != options.scene) from.add_input(options.scene);
  for (const std::string& input : simulation.inputs) from.add_input(input);

  const Result result = simulate(simulation, cli.common.seed);
  write_netcdf(simulation, result, from, output, {cli.common.overwrite, options.image_origins});
  if (!options.csv.empty()) write_file(options.csv, result_csv(simulation, result), cli.common.overwrite);
  write_quick_looks(cli, simulation, result);
  deliver_report(cli, "simulate", result_report(simulation, result), from);
  note(fmt::format("{} paths, {} rays in {:.1f} s; stopped by {}", result.samples, result.rays,
                   result.seconds, result.stopped_by));
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
  verb->add_flag("--image-origins", options->image_origins,
                 "keep the pixels of images by origin of the light too: total, direct, diffuse");
  verb->add_flag("--keep-interactions", options->keep_interactions,
                 "keep the histogram of interactions, for bpms recolour");
}

}  // namespace bpms
