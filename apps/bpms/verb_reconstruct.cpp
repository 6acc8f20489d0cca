#include <fmt/core.h>

#include <array>
#include <memory>
#include <vector>

#include "apps/bpms/verb.h"
#include "apps/bpms/verbs.h"
#include "calibrate/images/image_identity.h"
#include "core/atomic_file.h"
#include "core/base64.h"
#include "core/error.h"
#include "core/nearest.h"
#include "core/progress.h"
#include "core/statistics.h"
#include "core/text.h"
#include "reconstruct/photograph.h"
#include "reconstruct/report.h"

namespace bpms {
namespace {

struct ReconstructArguments {
  std::string points, rig, view, up, up_from, origin, disparity_map;
  std::string covariance = "total";
  std::vector<std::string> photographs;
  bool ignore_identity = false;
  double gate_p = ReconstructOptions{}.gate_p;
};

Eigen::Vector3d direction(const std::string& text) {
  Eigen::Vector3d out = Eigen::Vector3d::Zero();
  std::size_t at = 0;
  for (int i = 0; i < 3; ++i) {
    const std::size_t end = i < 2 ? text.find(',', at) : text.size();
    const auto number =
        end == std::string::npos ? std::nullopt : parse_number(std::string_view(text).substr(at, end - at));
    if (!number) bad_input({}, "--up: found {}, expected X,Y,Z such as 0,-1,0", in_quotes(text));
    out[i] = *number;
    at = end + 1;
  }
  if (!(out.norm() > 0)) bad_input({}, "--up: found {}, which has no direction", in_quotes(text));
  return out;
}

Json photographs_json(const ReconstructArguments& options, const Rig& rig, const Vectors& vectors,
                      Provenance& made) {
  Json out = Json::array();
  for (const std::string& text : options.photographs) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
      bad_input({}, "--photographs: found {}, expected CAMERA=FILE", in_quotes(text));
    const std::string name = text.substr(0, equals), path = text.substr(equals + 1);
    const int index = rig.find(name);
    if (index < 0) {
      std::vector<std::string> names;
      for (const Camera& camera : rig.cameras) names.push_back(camera.name);
      bad_input({}, "--photographs: the rig has no camera {}{}", in_quotes(name), did_you_mean(name, names));
    }
    const Camera& camera = rig.cameras[static_cast<std::size_t>(index)];
    const ImageSize size = image_size(path);
    if (size.width != camera.width_px || size.height != camera.height_px)
      bad_input({path}, "the photograph has {}x{} pixels, camera '{}' {}x{}", size.width, size.height, name,
                camera.width_px, camera.height_px);
    for (const ReconstructedPoint& p : vectors.points) {
      if (p.view != vectors.points.front().view)
        bad_input(p.where,
                  "the photographs show one view, the points are of the views {} and {}: choose with --view",
                  in_quotes(vectors.points.front().view), in_quotes(p.view));
    }
    for (const std::string& line : require_same_identity(camera, path, options.ignore_identity)) note(line);
    made.add_input(path);
    out.push_back({{"view", vectors.points.front().view},
                   {"camera", name},
                   {"width", size.width},
                   {"height", size.height},
                   {"data_uri", image_data_uri(path)}});
  }
  return out;
}

void note_rejected(const Vectors& vectors, const std::string& file) {
  for (const std::string& line : vectors.notes) note(fmt::format("{}: {}", file, line));
  for (const ReconstructedPoint& p : vectors.points) {
    if (p.accepted()) continue;
    const std::string chi2 =
        p.estimate ? fmt::format(" = {:.2f}, p = {:.2g}", p.estimate->chi2, p.estimate->p) : "";
    note(fmt::format("rejected: {}: {}{}", p.str(), p.reason, chi2));
  }
  const std::size_t refused = vectors.refused();
  note(fmt::format("{}: {} points, {} rejected", file, vectors.points.size() - refused, refused));
}

void require_some(const Vectors& vectors, const std::string& file) {
  if (vectors.refused() < vectors.points.size()) return;
  std::vector<std::pair<std::string, int>> reasons;
  for (const ReconstructedPoint& p : vectors.points) {
    const auto known =
        std::find_if(reasons.begin(), reasons.end(), [&](const auto& r) { return r.first == p.reason; });
    if (known == reasons.end())
      reasons.emplace_back(p.reason, 1);
    else
      ++known->second;
  }
  std::string list;
  for (const auto& [reason, count] : reasons)
    list += fmt::format("{}{} {}", list.empty() ? "" : ", ", count, reason);
  fail(ErrorKind::numeric, {file}, "all {} points were rejected: {}", vectors.points.size(), list);
}

std::string vectors_text(const Vectors& vectors, const Frame& frame, bool with_rig) {
  std::vector<VectorPoint> rows;
  for (const ReconstructedPoint& p : vectors.points) {
    if (!p.accepted()) continue;
    const Eigen::Matrix3d c = with_rig ? p.estimate->covariance_m2() : p.estimate->digitising_covariance_m2;
    rows.push_back(frame({p.label, p.point, p.estimate->x_m, c, p.where}));
  }
  return vectors_csv(rows);
}

// The rig's errors are the same for all points, which a fit of rows taken as independent does not know.
void note_common_errors(const Vectors& vectors) {
  constexpr double worth_a_note = 0.1;
  std::vector<double> shares;
  for (const ReconstructedPoint& p : vectors.points)
    if (p.accepted())
      shares.push_back(p.estimate->rig_covariance_m2.trace() / p.estimate->covariance_m2().trace());
  const double share = median(std::move(shares));
  if (share > worth_a_note)
    note(fmt::format(
        "{:.0f} % of the points' variance comes from the rig and is common to all of them: to fit "
        "them, take --covariance digitising",
        100 * share));
}

Json numbers(const Eigen::Vector3d& x) {
  return std::array<double, 3>{x.x(), x.y(), x.z()};
}

// Unit vector from the middle of the points to the middle of the cameras.
Eigen::Vector3d towards_cameras(const Vectors& vectors, const Rig& rig, const Frame& frame) {
  Eigen::Vector3d points = Eigen::Vector3d::Zero(), cameras = Eigen::Vector3d::Zero();
  const std::vector<VectorPoint> accepted = vectors.accepted();
  for (const VectorPoint& p : accepted) points += p.x_m / static_cast<double>(accepted.size());
  for (const Camera& c : rig.cameras)
    cameras -= c.r_cam_from_rig.transpose() * c.t_cam_from_rig_m / static_cast<double>(rig.cameras.size());
  return frame.rotation * (cameras - points).normalized();
}

Json frame_json(const Frame& frame, const ReconstructArguments& options) {
  Json rotation = Json::array();
  for (int i = 0; i < 3; ++i) rotation.push_back(numbers(frame.rotation.row(i)));
  const std::string up = !options.up_from.empty() ? "pot rim" : !options.up.empty() ? "given" : "rig";
  return {{"up", up},
          {"origin", options.origin.empty() ? "rig" : options.origin},
          {"rotation_from_rig", rotation},
          {"origin_in_rig_m", numbers(frame.origin_m)}};
}

void run(const Cli& cli, const ReconstructArguments& options) {
  Provenance made = provenance(cli);
  made.add_input(options.points);
  made.add_input(options.rig);
  const Rig rig = read_rig(options.rig);
  ReconstructOptions how;
  how.gate_p = options.gate_p;
  if (!options.view.empty()) how.view = options.view;
  const Vectors vectors = reconstruct(read_image_points(options.points), rig, how);
  note_rejected(vectors, options.points);
  require_some(vectors, options.points);

  Frame frame;
  Json figures = Json::array(), pot;
  if (!options.up.empty()) frame.rotation = upright(direction(options.up));
  if (!options.up_from.empty()) {
    made.add_input(options.up_from);
    const Vectors outline = reconstruct(read_image_points(options.up_from), rig, {how.gate_p, true, {}});
    note_rejected(outline, options.up_from);
    const Rim rim = fit_rim(pot_outline(outline), rig.covariance ? rig.covariance->matrix : Eigen::MatrixXd(),
                            image_up(rig));
    frame.rotation = upright(rim.normal);
    figures = rim_figures(rim);
    pot = {{"rejected", rejected_json(outline)}};
  }
  if (!options.origin.empty()) frame.origin_m = labelled_origin(options.origin, vectors);

  Json report = reconstruction_json(vectors, rig, frame);
  report["frame"] = frame_json(frame, options);
  // For the drawing: where up and the cameras are, in the frame of the points.
  const bool upright_frame = !options.up.empty() || !options.up_from.empty();
  if (upright_frame) report["vertical_m"] = {0.0, 0.0, 1.0};
  report["towards_cameras"] = numbers(towards_cameras(vectors, rig, frame));
  report["figures"] = figures;
  if (!pot.is_null()) report["pot"] = pot;
  if (!options.photographs.empty()) report["photographs"] = photographs_json(options, rig, vectors, made);
  if (!options.disparity_map.empty()) {
    made.add_input(options.disparity_map);
    report["check"] = check_json(check_disparity(options.disparity_map, vectors, rig));
  }
  if (options.covariance == "total") note_common_errors(vectors);
  const std::string text = vectors_text(vectors, frame, options.covariance == "total");
  if (!cli.common.output.empty() && cli.common.output != "-")
    write_file(cli.common.output, text, cli.common.overwrite);
  else if (!cli.common.json)
    fmt::print("{}", text);
  deliver_report(cli, "reconstruct", report, made);
}

}  // namespace

void add_reconstruct(Cli& cli) {
  auto options = std::make_shared<ReconstructArguments>();
  CLI::App* verb = add_verb(
      cli, "reconstruct", "labelled 3-D vectors with covariance from points digitised in the images of a rig",
      "bpms reconstruct points.csv --rig rig.toml -o vectors.csv --up-from pot.csv --origin organ=bud \\\n"
      "      --photographs left=left.jpg right=right.jpg --report reconstruct.html",
      [&cli, options] { run(cli, *options); });
  verb->add_option("points", options->points, "digitised image points (points.csv)")->required();
  verb->add_option("--rig", options->rig, "calibrated cameras (rig.toml)")->required();
  verb->add_option("--view", options->view, "only the points of this view");
  verb->add_option("--gate", options->gate_p,
                   "refuse a point whose chi-square is less probable (default 0.01)")
      ->check(CLI::Range(0.0, 0.5));
  verb->add_option("--covariance", options->covariance, "total, or digitising: without the rig's errors")
      ->check(CLI::IsMember({"total", "digitising"}));
  CLI::Option* up =
      verb->add_option("--up", options->up, "direction X,Y,Z in the rig's frame that becomes +z");
  verb->add_option("--up-from", options->up_from,
                   "points of a horizontal pot rim (organ pot, feature outline): +z")
      ->excludes(up);
  verb->add_option("--origin", options->origin,
                   "the labelled point that becomes the origin, such as organ=bud");
  verb->add_option("--photographs", options->photographs, "CAMERA=FILE ... to show in the report");
  verb->add_flag("--ignore-identity", options->ignore_identity,
                 "photographs of another camera or lens than the rig's are only noted");
  verb->add_option("--check-disparity", options->disparity_map,
                   "dense disparity map of a rectified pair (PNG)");
}

}  // namespace bpms
