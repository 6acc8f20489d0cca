#include <fmt/core.h>

#include <cmath>
#include <filesystem>

#include "apps/bpms/verb.h"
#include "apps/bpms/verbs.h"
#include "calibrate/targets/printing/printed_page.h"
#include "calibrate/targets/target_kind.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "core/progress.h"

namespace bpms {
namespace {

struct TargetArguments {
  std::string target, paper;
  std::vector<double> measured_bar_mm;
};

// Where the points came to lie, from the bars measured on the print.
void measure_points(const std::vector<double>& bar_mm, Target& target) {
  constexpr double farthest_off = 0.1;  // nobody's printer is; a bar in other units is
  for (const double bar : bar_mm) {
    if (!(std::abs(bar / check_bar_mm - 1) < farthest_off))
      bad_input(
          {}, "--measured-bar {}: expected two lengths near 100, in mm, along the rows and down the columns",
          bar);
  }
  target.measured_m = target.points_m();
  if (bar_mm.empty()) return;
  for (Eigen::Vector3d& x : target.measured_m) {
    x.x() *= bar_mm[0] / check_bar_mm;
    x.y() *= bar_mm[1] / check_bar_mm;
  }
}

void run_target(const Cli& cli, const TargetArguments& options) {
  const std::filesystem::path output = require_output(cli);
  const std::string ending = output.extension().string();
  if (ending != ".pdf" && ending != ".svg" && ending != ".toml")
    bad_input({output.string()}, "a target is written as .pdf, .svg, or .toml (its coordinates alone)");
  Target target = parse_target(options.target);
  const Drawing drawing = draw_target(target);
  measure_points(options.measured_bar_mm, target);
  const std::string board = std::filesystem::path(output).replace_extension(".toml").string();
  require_writable(board, cli.common.overwrite);
  if (ending != ".toml") {
    const PrintedPage page = lay_out(drawing, options.paper);
    write_file(output.string(), ending == ".pdf" ? pdf_of(page) : svg_of(page), cli.common.overwrite);
    note(fmt::format("{} on {} ({:.6g} x {:.6g} mm)", drawing.caption,
                     page.paper.empty() ? "a sheet of its own size" : page.paper, page.width, page.height));
  }
  write_file(board, "# " + drawing.caption + "\n" + board_toml(target), cli.common.overwrite);
  note(fmt::format("{} points in {}; calibrate with --target {}", target.size(), board, board));
  deliver_report(
      cli, "target",
      {{"kind", target.kind}, {"points", target.size()}, {"board", board}, {"caption", drawing.caption}},
      provenance(cli));
}

}  // namespace

void add_target(Cli& cli) {
  auto options = std::make_shared<TargetArguments>();
  CLI::App* verb = add_verb(cli, "target", "a target to print, and the coordinates of its points",
                            "bpms target apriltag:6x4:40mm:10mm -o board.pdf",
                            [&cli, options] { run_target(cli, *options); });
  verb->add_option("target", options->target,
                   fmt::format("{}, or a board.toml", fmt::join(target_forms(), ", ")))
      ->required();
  verb->add_option(
      "--page", options->paper,
      fmt::format("{}; else the smallest of A4 to A0 on which it fits", fmt::join(paper_names(), ", ")));
  verb->add_option("--measured-bar", options->measured_bar_mm,
                   "what the two bars of 100 mm measure on the print, in mm: across and down")
      ->expected(2);
}

}  // namespace bpms
