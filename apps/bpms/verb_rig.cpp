#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "apps/bpms/verb.h"
#include "apps/bpms/verbs.h"
#include "calibrate/exchange/rig_file.h"
#include "calibrate/pose.h"
#include "core/error.h"
#include "core/nearest.h"
#include "core/progress.h"
#include "core/text.h"
#include "core/units.h"

namespace bpms {
namespace {

struct RigArguments {
  std::string action, to, image_size, unit = "m";
  std::vector<std::string> files, cameras;
};

RigFromFile read_files(const RigArguments& options) {
  RigReading reading;
  if (!options.image_size.empty()) {
    const std::size_t cross = std::min(options.image_size.find('x'), options.image_size.size() - 1);
    const auto width = parse_integer(options.image_size.substr(0, cross));
    const auto height = parse_integer(options.image_size.substr(cross + 1));
    constexpr long long most = 1'000'000;
    if (!width || !height || *width < 1 || *height < 1 || *width > most || *height > most)
      bad_input({}, "--image-size {}; expected WIDTHxHEIGHT, as in 640x480", in_quotes(options.image_size));
    reading.size_px = {static_cast<int>(*width), static_cast<int>(*height)};
  }
  reading.unit_m = parse_length("1" + options.unit, {"--unit"});
  return read_rig_file(options.files, reading);
}

Rig chosen_cameras(const Rig& rig, const std::vector<std::string>& names) {
  if (names.empty()) return rig;
  Rig out;
  out.residual_sigma_px = rig.residual_sigma_px;
  std::vector<std::string> known;
  for (const Camera& camera : rig.cameras) known.push_back(camera.name);
  for (const std::string& name : names) {
    const int at = rig.find(name);
    if (at < 0)
      bad_input({}, "--cameras: the rig has no camera {}{}", in_quotes(name), did_you_mean(name, known));
    if (out.find(name) >= 0) bad_input({}, "--cameras: {} is named twice", in_quotes(name));
    out.cameras.push_back(rig.cameras[static_cast<std::size_t>(at)]);
  }
  if (!rig.covariance) return out;
  std::vector<Eigen::Index> kept;
  out.covariance = Rig::Covariance{{}, {}, rig.covariance->kind};
  for (std::size_t i = 0; i < rig.covariance->order.size(); ++i) {
    const std::string& name = rig.covariance->order[i];
    if (out.find(name.substr(0, name.rfind('.'))) < 0) continue;
    out.covariance->order.push_back(name);
    kept.push_back(static_cast<Eigen::Index>(i));
  }
  out.covariance->matrix = rig.covariance->matrix(kept, kept);
  return out;
}

// NaN: not in the covariance.
double sigma_of(const Rig& rig, const std::string& name) {
  if (!rig.covariance) return NAN;
  const auto& order = rig.covariance->order;
  const auto at = std::find(order.begin(), order.end(), name) - order.begin();
  if (at == static_cast<std::ptrdiff_t>(order.size())) return NAN;
  return std::sqrt(std::max(0.0, rig.covariance->matrix(at, at)));
}

Json camera_row(const Rig& rig, const Camera& camera) {
  Json numbers = Json::array();
  const std::vector<std::string> names = parameter_names(camera);
  for (std::size_t i = 0; i < camera.parameters.size(); ++i)
    numbers.push_back({{"name", names[i]},
                       {"value", camera.parameters[i]},
                       {"sigma", json_number(sigma_of(rig, camera.name + "." + names[i]))}});
  return {{"name", camera.name},        {"model", camera.model}, {"width", camera.width_px},
          {"height", camera.height_px}, {"parameters", numbers}, {"identity", camera.identity}};
}

struct PairRow {
  std::string a, b;
  double baseline_m = 0, sigma_m = NAN, angle_deg = 0;
};
PairRow pair_row(const Rig& rig, std::size_t a, std::size_t b) {
  const Camera &first = rig.cameras[a], &second = rig.cameras[b];
  const Pose pose = Pose{second.r_cam_from_rig, second.t_cam_from_rig_m} *
                    Pose{first.r_cam_from_rig, first.t_cam_from_rig_m}.inverse();
  PairRow out{first.name, second.name, pose.t_m.norm(), NAN, degrees(vector_from_rotation(pose.r).norm())};
  if (!rig.covariance || !(out.baseline_m > 0)) return out;
  // The centre of a camera is -R't. For R <- exp(w) R it moves by R' [w]x t, for t by -R'.
  const Eigen::Vector3d centre_a = -(first.r_cam_from_rig.transpose() * first.t_cam_from_rig_m),
                        centre_b = -(second.r_cam_from_rig.transpose() * second.t_cam_from_rig_m);
  const Eigen::Vector3d along = (centre_b - centre_a).normalized();
  const auto& order = rig.covariance->order;
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(order.size()));
  for (const auto& [camera, sign] : {std::pair(&first, -1.0), {&second, 1.0}}) {
    Eigen::Matrix<double, 3, 6> by;
    by << -camera->r_cam_from_rig.transpose() * cross_matrix(camera->t_cam_from_rig_m),
        -camera->r_cam_from_rig.transpose();
    constexpr const char* names[] = {"rx", "ry", "rz", "tx", "ty", "tz"};
    for (int k = 0; k < 6; ++k) {
      const auto at = std::find(order.begin(), order.end(), camera->name + "." + names[k]) - order.begin();
      if (at < static_cast<std::ptrdiff_t>(order.size())) gradient[at] += sign * along.dot(by.col(k));
    }
  }
  out.sigma_m = std::sqrt(std::max(0.0, gradient.dot(rig.covariance->matrix * gradient)));
  return out;
}

std::string plus_minus(double sigma, int digits) {
  return std::isfinite(sigma) ? fmt::format(" +- {:.{}g}", sigma, digits) : "";
}

void show(const Cli& cli, const RigArguments& options) {
  const RigFromFile read = read_files(options);
  const Rig rig = chosen_cameras(read.rig, options.cameras);
  Json report{{"cameras", Json::array()}, {"pairs", Json::array()}};
  const bool print = !cli.common.json;
  for (const Camera& camera : rig.cameras) {
    const Json row = camera_row(rig, camera);
    report["cameras"].push_back(row);
    if (!print) continue;
    fmt::print("{}: {}x{} pixels, {}\n", camera.name, camera.width_px, camera.height_px, camera.model);
    const std::vector<std::string> names = parameter_names(camera);
    constexpr std::size_t most = 12;  // the numbers of a grid are no table
    for (std::size_t i = 0; i < std::min(most, camera.parameters.size()); ++i)
      fmt::print("  {:<4} {:>14.8g}{}\n", names[i], camera.parameters[i],
                 plus_minus(sigma_of(rig, camera.name + "." + names[i]), 3));
    if (camera.parameters.size() > most) fmt::print("  ... and {} more\n", camera.parameters.size() - most);
    for (const auto& [key, value] : camera.identity)
      if (!value.empty()) fmt::print("  {}: {}\n", key, value);
  }
  for (std::size_t a = 0; a < rig.cameras.size(); ++a) {
    for (std::size_t b = a + 1; b < rig.cameras.size(); ++b) {
      const PairRow row = pair_row(rig, a, b);
      report["pairs"].push_back({{"a", row.a},
                                 {"b", row.b},
                                 {"baseline_m", json_number(row.baseline_m)},
                                 {"baseline_sigma_m", json_number(row.sigma_m)},
                                 {"angle_deg", json_number(row.angle_deg)}});
      if (print)
        fmt::print("{} - {}: {:.4f} mm{} apart, turned by {:.4f} degrees\n", row.a, row.b,
                   1e3 * row.baseline_m, plus_minus(1e3 * row.sigma_m, 3), row.angle_deg);
    }
  }
  if (rig.residual_sigma_px > 0) report["residual_sigma_px"] = rig.residual_sigma_px;
  if (rig.covariance) report["covariance_kind"] = rig.covariance->kind;
  if (print && rig.covariance)
    fmt::print("sigmas are {}; corners erred by {:.3f} px\n", rig.covariance->kind, rig.residual_sigma_px);
  for (const std::string& line : read.notes) note(line);
  Provenance made_from = provenance(cli);
  for (const std::string& path : options.files) made_from.add_input(path);
  deliver_report(cli, "rig", report, made_from);
}

void convert(const Cli& cli, const RigArguments& options) {
  const std::string& output = require_output(cli);
  const RigFromFile read = read_files(options);
  const Rig rig = chosen_cameras(read.rig, options.cameras);
  for (const std::string& line : read.notes) note(line);
  const FilesOfRig files = rig_files(rig, output, options.to);
  for (const std::string& line : write_rig_file(rig, output, options.to, cli.common.overwrite)) note(line);
  Json written = Json::array();
  for (const RigFileText& file : files.files) {
    written.push_back(file.path);
    note("wrote " + file.path);
  }
  deliver_report(cli, "rig", {{"files", written}, {"cameras", rig.cameras.size()}}, provenance(cli));
}

}  // namespace

void add_rig(Cli& cli) {
  auto options = std::make_shared<RigArguments>();
  CLI::App* verb = add_verb(
      cli, "rig", "show calibrated cameras, or convert them from and to the files of other programs",
      "bpms rig show rig.toml\n  bpms rig convert intrinsics.yml extrinsics.yml --image-size 640x480 -o "
      "rig.toml\n"
      "  bpms rig convert rig.toml --to mrcal -o models/",
      [&cli, options] { options->action == "show" ? show(cli, *options) : convert(cli, *options); },
      OutputKind::file_or_folder);
  std::string formats;
  for (const RigFormat& format : rig_formats())
    formats += (formats.empty() ? "" : ", ") + std::string(format.name);
  verb->add_option("action", options->action, "show or convert")
      ->required()
      ->check(CLI::IsMember({"show", "convert"}));
  verb->add_option("files", options->files, "camera files: all together one rig; COLMAP: a folder")
      ->required();
  verb->add_option("--to", options->to, "format of the output: " + formats + " (default: from its name)");
  verb->add_option("--cameras", options->cameras, "only these, in this order")->delimiter(',');
  verb->add_option("--image-size", options->image_size, "of the images, where the file does not say it");
  verb->add_option("--unit", options->unit, "of lengths, where the format does not say it (default m)");
}

}  // namespace bpms
