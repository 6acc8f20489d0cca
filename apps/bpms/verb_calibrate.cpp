#include <fmt/core.h>

#include "apps/bpms/calibrate_report.h"
#include "apps/bpms/verb.h"
#include "apps/bpms/verbs.h"
#include "calibrate/calibrate.h"
#include "calibrate/images/find_corners.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "core/progress.h"
#include "core/text.h"
#include "core/units.h"

namespace bpms {
namespace {

struct CalibrateArguments {
  std::vector<std::string> images;
  std::string corners, image_size, target, model = "brown4";
  double turntable_deg = 0;
  bool no_warp = false, moving_rig = false, free_points = false;
};

std::pair<int, int> parse_size(const std::string& text) {
  const std::size_t cross = text.find('x');
  if (cross != std::string::npos) {
    const auto width = parse_integer(text.substr(0, cross)), height = parse_integer(text.substr(cross + 1));
    constexpr long long most = 1'000'000;
    if (width && height && *width > 0 && *height > 0 && *width <= most && *height <= most)
      return {static_cast<int>(*width), static_cast<int>(*height)};
  }
  bad_input({}, "--image-size {}; expected WIDTHxHEIGHT, as in 640x480", in_quotes(text));
}

void tell(const Calibration& c, const Observations& observations) {
  for (const auto& [image, reason] : observations.skipped) note(fmt::format("skipped {}: {}", image, reason));
  for (const auto& view : c.views) {
    if (view.outlier) note(fmt::format("outlier view {}: {}", view.image, view.reason));
  }
  if (!c.clustered_absent.empty())
    note("no clustered sigmas, the iid ones are too small on real boards: " + c.clustered_absent);
  note(fmt::format("{} of {} corners in {} views ({} images skipped), residual {:.3f} px, solved in {:.2f} s",
                   c.corners_used, c.corners_total, c.views.size(), observations.skipped.size(),
                   c.residual_sigma_px, c.solve_seconds));
  if (c.turntable)
    note(fmt::format(
        "turntable: axis ({:.5f}, {:.5f}, {:.5f}) +- {:.2g} rad through ({:.4f}, {:.4f}, {:.4f}) m +- {:.2g} "
        "m",
        c.turntable->direction.x(), c.turntable->direction.y(), c.turntable->direction.z(),
        c.turntable->direction_sigma_clustered_rad, c.turntable->point_m.x(), c.turntable->point_m.y(),
        c.turntable->point_m.z(), c.turntable->point_sigma_clustered_m));
  for (const auto& pair : c.pairs)
    note(fmt::format("baseline {} - {}: {:.3f} mm +- {:.3f} mm ({:.3f} as if corners erred independently)",
                     c.rig.cameras[static_cast<std::size_t>(pair.a)].name,
                     c.rig.cameras[static_cast<std::size_t>(pair.b)].name, pair.baseline_m * 1e3,
                     pair.baseline_sigma_clustered_m.value_or(pair.baseline_sigma_m) * 1e3,
                     pair.baseline_sigma_m * 1e3));
}

void run(const Cli& cli, const CalibrateArguments& options) {
  const std::string& output = require_output(cli);
  const Target target = parse_target(options.target);
  CalibrateOptions settings;
  settings.lens = options.model;
  settings.board_warp = !options.no_warp;
  settings.rig_moves = options.moving_rig;
  settings.free_points = options.free_points;
  settings.table_step_rad = radians(options.turntable_deg);
  if (options.moving_rig && options.turntable_deg != 0)
    bad_input({}, "--moving-rig and --turntable exclude each other");
  Provenance made_from = provenance(cli);
  if (options.target.ends_with(".toml")) made_from.add_input(options.target);
  Observations observations;
  if (!options.corners.empty()) {
    if (!options.images.empty()) bad_input({}, "--images and --corners exclude each other");
    if (options.image_size.empty()) bad_input({}, "--corners needs --image-size WIDTHxHEIGHT");
    const auto [width, height] = parse_size(options.image_size);
    observations = read_corners(options.corners, width, height, target.size());
    made_from.add_input(options.corners);
  } else {
    if (options.images.empty()) bad_input({}, "nothing to calibrate from: give --images or --corners");
    observations = find_corners(expand_patterns(options.images), target);
    for (const BoardView& view : observations.views) made_from.add_input(view.image);
  }
  for (const auto& camera : observations.cameras)
    note(fmt::format("camera {}: {}x{} pixels", camera.name, camera.width_px, camera.height_px));
  const Calibration result = calibrate(observations, target, settings);
  tell(result, observations);
  write_file(output, rig_toml(result.rig, "bpms " + version() + "\n" + in_quotes(cli.command)),
             cli.common.overwrite);
  deliver_report(cli, "calibrate", calibration_json(result, observations, {target}, options.model),
                 made_from);
}

}  // namespace

void add_calibrate(Cli& cli) {
  auto options = std::make_shared<CalibrateArguments>();
  CLI::App* verb = add_verb(
      cli, "calibrate", "cameras, lenses and poses from images of a target",
      "bpms calibrate --images 'left[0-9]*.jpg' 'right[0-9]*.jpg' --target chessboard:9x6:25mm -o rig.toml",
      [&cli, options] { run(cli, *options); });
  verb->add_option("--images", options->images, "images or patterns; left01.jpg is frame 01 of camera left");
  verb->add_option("--corners", options->corners, "corners already found: rows of filename x y level");
  verb->add_option("--image-size", options->image_size, "of the images behind --corners, as in 640x480");
  verb->add_option("--target", options->target,
                   "chessboard:COLUMNSxROWS:SQUARE (inner corners) or board.toml")
      ->required();
  verb->add_option("--model", options->model,
                   "lens: brown4 (k1 k2 p1 p2, default), brown5 (k3), brown8 (rational)");
  verb->add_flag("--no-warp", options->no_warp, "take the board as flat");
  verb->add_flag("--moving-rig", options->moving_rig, "the rig is carried around a target that stands");
  verb->add_option(
      "--turntable", options->turntable_deg,
      "the target stands on a table that turns by so many degrees from one frame number to the next");
  verb->add_flag("--free-points", options->free_points,
                 "estimate the points of what stands, with their place together as the datum");
}

}  // namespace bpms
