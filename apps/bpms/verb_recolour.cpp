#include "apps/bpms/verb.h"
#include "apps/bpms/verbs.h"
#include "core/atomic_file.h"
#include "core/progress.h"
#include "simulate/output/output.h"
#include "simulate/recolour/recolour.h"

namespace bpms {
namespace {

struct RecolourArguments {
  std::string recording;
  std::string materials;
  std::string csv;
  std::string derivatives;
};

void run(const Cli& cli, const RecolourArguments& options) {
  const std::string& output = require_output(cli);
  require_outputs(cli, {output, options.csv, options.derivatives});
  Recording recording = read_recording(options.recording);
  Simulation with = recoloured_simulation(recording, options.materials);
  Provenance from = provenance(cli);
  from.add_input(options.recording);
  for (const std::string& input : with.inputs) from.add_input(input);

  Derivatives derivatives;
  const Result result = recolour(recording, with, options.derivatives.empty() ? nullptr : &derivatives);
  with.sensors = std::move(recording.simulation.sensors);  // the results point to them
  write_netcdf(with, result, from, output, {cli.common.overwrite, false});
  if (!options.csv.empty()) write_file(options.csv, result_csv(with, result), cli.common.overwrite);
  if (!options.derivatives.empty())
    write_file(options.derivatives, derivatives_csv(with, result, derivatives), cli.common.overwrite);
  deliver_report(cli, "recolour", result_report(with, result), from);
}

}  // namespace

void add_recolour(Cli& cli) {
  auto options = std::make_shared<RecolourArguments>();
  CLI::App* verb = add_verb(cli, "recolour", "give a simulated result other spectra, without tracing again",
                            "bpms recolour out.nc --materials other.toml -o new.nc",
                            [&cli, options] { run(cli, *options); });
  verb->add_option("result", options->recording, "what bpms simulate --keep-interactions wrote")->required();
  verb->add_option("--materials", options->materials,
                   "TOML with [materials.X], and [bands] where they are others")
      ->required();
  verb->add_option("--csv", options->csv, "the results as a tidy table");
  verb->add_option("--derivatives", options->derivatives,
                   "a table of the derivatives of reflectance by each material's spectra");
}

}  // namespace bpms
