#include <fmt/core.h>

#include <filesystem>

#include "apps/bpms/calibrate_check.h"
#include "apps/bpms/calibrate_report.h"
#include "apps/bpms/verb.h"
#include "apps/bpms/verbs.h"
#include "calibrate/calibrate.h"
#include "calibrate/images/find_corners.h"
#include "calibrate/images/image_identity.h"
#include "calibrate/lens_selection.h"
#include "calibrate/lenses/lens.h"
#include "calibrate/targets/target_kind.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "core/nearest.h"
#include "core/progress.h"
#include "core/text.h"
#include "core/units.h"

namespace bpms {
namespace {

struct CalibrateArguments {
  std::vector<std::string> images, targets;
  std::string corners, image_size, debug_images, model = "brown4";
  std::vector<std::string> identity;  // CAMERA.KEY=VALUE
  CheckRigArguments check;
  double turntable_deg = 0;
  bool no_warp = false, moving_rig = false, free_points = false;
};

void tell(const Calibration& c, const Observations& observations) {
  for (const auto& [image, reason] : observations.skipped) note(fmt::format("skipped {}: {}", image, reason));
  for (const auto& [image, remark] : observations.remarks) note(fmt::format("{}: {}", image, remark));
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

void tell_selection(const LensSelection& selection) {
  note(fmt::format("lens by cross-validation, {} folds of {} frames:", selection.folds, selection.frames));
  for (const LensScore& score : selection.scores) {
    if (!score.refused.empty())
      note(fmt::format("  {:8} refused: {}", score.lens, score.refused));
    else
      note(fmt::format("  {:8} {:3} parameters, rms {:.4f} px, predicts to {:.4f} +- {:.4f} px{}", score.lens,
                       score.parameters, score.in_sample_rms_px, score.predicted_rms_px,
                       score.predicted_se_px, score.chosen ? ", chosen" : ""));
  }
}

// From the images, then what the user says, which counts more.
void identify_cameras(const Observations& observations, const std::vector<std::string>& said, Rig& rig) {
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    std::vector<std::string> images, differences;
    for (const BoardView& view : observations.views)
      if (view.camera == static_cast<int>(c) && std::filesystem::exists(view.image))
        images.push_back(view.image);
    rig.cameras[c].identity = common_identity(images, differences);
    for (const std::string& line : differences) note(line);
  }
  for (const std::string& text : said) {
    const std::size_t dot = text.find('.'), equals = text.find('=');
    if (dot == std::string::npos || equals == std::string::npos || dot + 1 >= equals)
      bad_input({}, "--identity {}; expected CAMERA.KEY=VALUE, as in left.serial=40123", in_quotes(text));
    const int camera = rig.find(text.substr(0, dot));
    std::vector<std::string> names;
    for (const Camera& one : rig.cameras) names.push_back(one.name);
    if (camera < 0)
      bad_input({}, "--identity: no camera {}{}", in_quotes(text.substr(0, dot)),
                did_you_mean(text.substr(0, dot), names));
    rig.cameras[static_cast<std::size_t>(camera)].identity[text.substr(dot + 1, equals - dot - 1)] =
        text.substr(equals + 1);
  }
}

void run_check(const Cli& cli, const CalibrateArguments& options) {
  CheckRigArguments check = options.check;
  check.images.insert(check.images.end(), options.images.begin(), options.images.end());
  if (options.targets.size() > 1)
    bad_input({}, "--check takes one --target; {} are given", options.targets.size());
  check.target = options.targets.front();
  check.no_warp = options.no_warp;
  if (!options.corners.empty() || !options.identity.empty() || !cli.common.output.empty())
    bad_input({}, "--check goes with images, --target and --report; not with --corners, --identity or -o");
  check_rig_of(cli, check);
}

void run(const Cli& cli, const CalibrateArguments& options) {
  if (!options.check.rig.empty()) return run_check(cli, options);
  if (!options.check.images.empty())
    bad_input({}, "found {}: images to calibrate from are named behind --images",
              in_quotes(options.check.images.front()));
  const std::string& output = require_output(cli);
  const std::vector<Target> targets = parse_targets(options.targets);
  CalibrateOptions settings;
  settings.lens = options.model;
  if (options.model != "auto") lens_choice(options.model);  // known, before the work
  settings.board_warp = !options.no_warp;
  settings.rig_moves = options.moving_rig;
  settings.free_points = options.free_points;
  settings.table_step_rad = radians(options.turntable_deg);
  if (options.moving_rig && options.turntable_deg != 0)
    bad_input({}, "--moving-rig and --turntable exclude each other");
  Provenance made_from = provenance(cli);
  for (const std::string& text : options.targets)
    if (is_target_file(text)) made_from.add_input(text);
  Observations observations;
  if (!options.corners.empty()) {
    if (!options.images.empty()) bad_input({}, "--images and --corners exclude each other");
    if (options.image_size.empty()) bad_input({}, "--corners needs --image-size WIDTHxHEIGHT");
    if (targets.size() > 1) bad_input({}, "--corners are those of one target; {} are given", targets.size());
    const auto [width, height] = parse_image_size(options.image_size);
    observations = read_corners(options.corners, width, height, targets.front().size());
    made_from.add_input(options.corners);
  } else {
    if (options.images.empty()) bad_input({}, "nothing to calibrate from: give --images or --corners");
    observations =
        find_corners(expand_patterns(options.images), targets, {options.debug_images, cli.common.overwrite});
    for (const BoardView& view : observations.views) made_from.add_input(view.image);
  }
  for (const auto& camera : observations.cameras)
    note(fmt::format("camera {}: {}x{} pixels", camera.name, camera.width_px, camera.height_px));
  std::optional<LensSelection> selection;
  if (options.model == "auto") {
    selection = choose_lens(observations, targets, {.calibrate = settings});
    settings.lens = selection->chosen;
    tell_selection(*selection);
  }
  Calibration result = calibrate(observations, targets, settings);
  tell(result, observations);
  identify_cameras(observations, options.identity, result.rig);
  write_file(output, rig_toml(result.rig, "bpms " + version() + "\n" + in_quotes(cli.command)),
             cli.common.overwrite);
  Json made = calibration_json(result, observations, targets, settings.lens);
  if (selection) made["lens_selection"] = lens_selection_json(*selection);
  deliver_report(cli, "calibrate", made, made_from);
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
  verb->add_option("--target", options->targets,
                   fmt::format("{}, a board.toml or a control_frame.toml; several where images show several",
                               fmt::join(target_forms(), ", ")))
      ->required();
  verb->add_option("--debug-images", options->debug_images,
                   "a folder for pictures of what was found in each image");
  verb->add_option(
      "--model", options->model,
      "lens: pinhole, brown4 (k1 k2 p1 p2, default), brown5 (k3), brown8 (rational), fisheye, splined "
      "(or splined:COLUMNSxROWS), auto (by cross-validation)");
  verb->add_flag("--no-warp", options->no_warp, "take the board as flat");
  verb->add_option("--identity", options->identity,
                   "CAMERA.KEY=VALUE ..., kept in the rig besides what the images say: left.serial=40123");
  verb->add_option("--check", options->check.rig,
                   "rig.toml: does it still hold, by these images of the board? Exit 5 when it does not");
  verb->add_option("shot", options->check.images,
                   "with --check: images of the board, shot_left.png shot_right.png");
  verb->add_option("--corner-sigma", options->check.corner_sigma_px,
                   "with --check: pixels by which corners err (default: the rig's residual_sigma_px)")
      ->check(CLI::PositiveNumber);
  verb->add_option("--least-p", options->check.least_p,
                   "with --check: what is less probable does not hold (default 0.001)")
      ->check(CLI::Range(1e-12, 0.5));
  verb->add_flag("--ignore-identity", options->check.ignore_identity,
                 "with --check: images of another camera or lens are checked all the same");
  verb->add_flag("--moving-rig", options->moving_rig, "the rig is carried around a target that stands");
  verb->add_option(
      "--turntable", options->turntable_deg,
      "the target stands on a table that turns by so many degrees from one frame number to the next");
  verb->add_flag("--free-points", options->free_points,
                 "estimate the points of what stands, with their place together as the datum");
}

}  // namespace bpms
