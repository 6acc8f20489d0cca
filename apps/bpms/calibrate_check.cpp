#include "apps/bpms/calibrate_check.h"

#include <fmt/core.h>

#include "calibrate/check.h"
#include "calibrate/images/find_corners.h"
#include "calibrate/images/image_identity.h"
#include "core/error.h"
#include "core/progress.h"

namespace bpms {
namespace {

Json verdict_json(const ChiSquareVerdict& v) {
  return {{"name", v.name},
          {"chi2", json_number(v.chi2)},
          {"degrees_of_freedom", v.dof},
          {"p", json_number(v.p)},
          {"holds", v.holds}};
}

Json check_report(const RigCheck& c, const Observations& shot, double least_p) {
  Json out{{"holds", c.holds()},
           {"least_p", least_p},
           {"rig", verdict_json(c.rig)},
           {"cameras", Json::array()},
           {"pairs", Json::array()},
           {"corner_sigma_px", c.corner_sigma_px},
           {"residual_rms_px", json_number(c.residual_rms_px)},
           {"rig_has_covariance", c.rig_has_covariance},
           {"views", Json::array()},
           {"skipped", Json::array()}};
  for (const ChiSquareVerdict& camera : c.cameras) out["cameras"].push_back(verdict_json(camera));
  for (const RigCheck::Epipolar& pair : c.pairs)
    out["pairs"].push_back({{"a", pair.a},
                            {"b", pair.b},
                            {"corners", pair.corners},
                            {"epipolar_rms_px", json_number(pair.rms_px)},
                            {"expected_px", json_number(pair.expected_px)}});
  if (c.scale)
    out["scale"] = {{"ratio", json_number(c.scale->ratio)},
                    {"sigma", json_number(c.scale->sigma)},
                    {"p", json_number(c.scale->p)},
                    {"holds", c.scale->holds}};
  if (!c.swapped.empty()) out["exchanged"] = c.swapped;
  for (const BoardView& view : shot.views)
    out["views"].push_back({{"image", view.image},
                            {"camera", shot.cameras[static_cast<std::size_t>(view.camera)].name},
                            {"frame", view.frame},
                            {"corners", view.corners.size()}});
  for (const auto& [image, reason] : shot.skipped)
    out["skipped"].push_back({{"image", image}, {"reason", reason}});
  return out;
}

void print_verdict(const ChiSquareVerdict& v, const char* what) {
  fmt::print("{:<28} chi2 {:9.1f} of {:4} degrees of freedom, p = {:.3g}: {}\n",
             v.name == "rig" ? std::string("rig as a whole") : fmt::format("{} {}", what, v.name), v.chi2,
             v.dof, v.p, v.holds ? "holds" : "DOES NOT HOLD");
}

void print_check(const RigCheck& c) {
  print_verdict(c.rig, "");
  for (const ChiSquareVerdict& camera : c.cameras) print_verdict(camera, "lens of");
  for (const RigCheck::Epipolar& pair : c.pairs)
    fmt::print("{:<28} {:.3f} px over {} corners, {:.3f} px expected of the corners alone\n",
               "epipolar " + pair.a + " - " + pair.b, pair.rms_px, pair.corners, pair.expected_px);
  if (c.scale)
    fmt::print("{:<28} the board measures {:.5f} +- {:.5f} of its size, p = {:.3g}: {}\n", "scale",
               c.scale->ratio, c.scale->sigma, c.scale->p, c.scale->holds ? "holds" : "DOES NOT HOLD");
}

std::string what_failed(const RigCheck& c) {
  if (!c.swapped.empty()) return fmt::format("the images of {} are exchanged", c.swapped);
  for (const ChiSquareVerdict& camera : c.cameras)
    if (!camera.holds)
      return fmt::format("the lens of camera {} is not as calibrated (p = {:.2g})", in_quotes(camera.name),
                         camera.p);
  if (c.scale && !c.scale->holds)
    return fmt::format(
        "the board comes out {:.4f} times as large as it should (p = {:.2g}): another board, a moved "
        "camera or a changed focus",
        c.scale->ratio, c.scale->p);
  return fmt::format("the cameras do not stand to each other as calibrated (p = {:.2g})", c.rig.p);
}

}  // namespace

void check_rig_of(const Cli& cli, const CheckRigArguments& arguments) {
  const Rig rig = read_rig(arguments.rig);
  const Target target = parse_target(arguments.target);
  Provenance made_from = provenance(cli);
  made_from.add_input(arguments.rig);
  if (arguments.images.empty()) bad_input({}, "--check: no images of the board are given");
  std::vector<std::string> names;
  for (const Camera& camera : rig.cameras) names.push_back(camera.name);
  FindOptions finding;
  finding.name_of = [&names](const std::string& path) { return parse_shot_name(path, names); };
  const Observations shot = find_corners(expand_patterns(arguments.images), target, finding);
  for (const auto& [image, reason] : shot.skipped) note(fmt::format("skipped {}: {}", image, reason));
  if (shot.views.empty())
    bad_input({}, "no image shows the board{}",
              shot.skipped.empty()
                  ? ""
                  : fmt::format("; the first, {}: {}", shot.skipped[0].image, shot.skipped[0].reason));
  for (const BoardView& view : shot.views) {
    made_from.add_input(view.image);
    const int camera = rig.find(shot.cameras[static_cast<std::size_t>(view.camera)].name);
    for (const std::string& line : require_same_identity(rig.cameras[static_cast<std::size_t>(camera)],
                                                         view.image, arguments.ignore_identity))
      note(line);
  }
  RigCheckOptions options;
  options.least_p = arguments.least_p;
  options.board_warp = !arguments.no_warp;
  options.corner_sigma_px = arguments.corner_sigma_px;
  const RigCheck check = check_rig(rig, shot, target, options);
  if (!check.rig_has_covariance)
    note("the rig has no covariance: its own errors are taken as none, and the check is too strict");
  if (!cli.common.json) print_check(check);
  deliver_report(cli, "check_rig", check_report(check, shot, options.least_p), made_from);
  if (!check.holds())
    fail(ErrorKind::refused, {arguments.rig}, "the rig does not hold: {}", what_failed(check));
}

}  // namespace bpms
