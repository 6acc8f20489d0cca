#include "apps/bpms/verb.h"

#include <fmt/core.h>

#include <filesystem>
#include <set>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/text.h"

namespace bpms {

bool names_folder(const std::string& output) {
  std::error_code none;
  return output.ends_with('/') || std::filesystem::is_directory(output, none);
}

CLI::App* add_verb(Cli& cli, const std::string& name, const std::string& summary, const std::string& example,
                   std::function<void()> run, OutputKind output) {
  CLI::App* verb = cli.app.add_subcommand(name, summary);
  CommonOptions& common = cli.common;
  verb->add_option("-o,--output", common.output, "output file");
  verb->add_option("--report", common.report, "report of the run: FILE.json, or FILE.html to look at");
  verb->add_option("--seed", common.seed,
                   "seed of the run (default 1); a canopy is planted by the seed in its file");
  verb->add_option("--threads", common.threads, "threads (default: all cores)")->check(CLI::Range(0, 1024));
  verb->add_flag("--quiet", common.quiet, "no progress and no notes");
  verb->add_flag("--json", common.json, "the report on stdout as one JSON object");
  verb->add_flag("--overwrite", common.overwrite, "replace existing outputs");
  verb->footer("Example:\n  " + example);
  verb->callback([&cli, output, run = std::move(run)] {
    set_quiet(cli.common.quiet);
    set_threads(cli.common.threads);
    const bool own_business = output == OutputKind::file_or_folder && names_folder(cli.common.output);
    require_outputs(cli, own_business ? std::vector<std::string>{} : std::vector{cli.common.output});
    run();
  });
  return verb;
}

Provenance provenance(const Cli& cli, bool with_seed) {
  Provenance out;
  out.command = cli.command;
  if (with_seed) out.seed = cli.common.seed;
  return out;
}

void require_outputs(const Cli& cli, const std::vector<std::string>& outputs) {
  std::vector<std::string> all = outputs;
  all.push_back(cli.common.report);
  std::set<std::filesystem::path> taken;
  for (const std::string& output : all) {
    if (output.empty() || output == "-") continue;
    require_writable(output, cli.common.overwrite);
    if (!taken.insert(std::filesystem::weakly_canonical(std::filesystem::absolute(output))).second)
      bad_input({output}, "two outputs go to this one file");
  }
}

const std::string& require_output(const Cli& cli) {
  if (cli.common.output.empty()) throw Error(ErrorKind::bad_input, "no output file: give -o FILE");
  if (cli.common.output == "-")
    throw Error(ErrorKind::bad_input, "-o -: this verb does not write to stdout; give a file's name");
  return cli.common.output;
}

void deliver_report(const Cli& cli, const std::string& verb, Json report, const Provenance& provenance) {
  Json out{{"report", verb}};
  out.update(report);
  out["provenance"] = provenance.json();
  // Names from files in another encoding than UTF-8 must not cost the report.
  constexpr auto replace = Json::error_handler_t::replace;
  if (cli.common.json) fmt::print("{}\n", out.dump(-1, ' ', false, replace));
  const std::string& path = cli.common.report;
  if (path.empty()) return;
  if (path.ends_with(".html")) {
    const Json page{
        {"title", "bpms " + verb}, {"version", version()}, {"command", cli.command}, {"reports", {out}}};
    write_file(path, html_page(page), cli.common.overwrite);
  } else {
    write_file(path, out.dump(1, ' ', false, replace) + "\n", cli.common.overwrite);
  }
}

std::pair<int, int> parse_image_size(const std::string& text) {
  const std::size_t cross = text.find('x');
  if (cross != std::string::npos) {
    const auto width = parse_integer(text.substr(0, cross)), height = parse_integer(text.substr(cross + 1));
    constexpr long long most = 1'000'000;
    if (width && height && *width > 0 && *height > 0 && *width <= most && *height <= most)
      return {static_cast<int>(*width), static_cast<int>(*height)};
  }
  bad_input({}, "--image-size {}; expected WIDTHxHEIGHT, as in 640x480", in_quotes(text));
}

}  // namespace bpms
