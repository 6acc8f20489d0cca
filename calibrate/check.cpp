#include "calibrate/check.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "calibrate/check_problem.h"
#include "core/nearest.h"

namespace bpms {
namespace {

Shot shot_of(const Rig& rig, const Observations& observations, const Target& target) {
  Shot out;
  out.points_m = target.points_m();
  out.bending = target.bending();
  std::vector<int> camera_of;
  std::vector<std::string> names;
  for (const Camera& camera : rig.cameras) names.push_back(camera.name);
  for (const auto& observed : observations.cameras) {
    const int c = rig.find(observed.name);
    if (c < 0)
      bad_input({}, "the rig has no camera {}{}", in_quotes(observed.name),
                did_you_mean(observed.name, names));
    const Camera& camera = rig.cameras[static_cast<std::size_t>(c)];
    if (camera.width_px != observed.width_px || camera.height_px != observed.height_px)
      bad_input({}, "images of camera {} have {}x{} pixels, the rig's have {}x{}", in_quotes(camera.name),
                observed.width_px, observed.height_px, camera.width_px, camera.height_px);
    camera_of.push_back(c);
  }
  std::vector<std::string> frames;
  for (const BoardView& view : observations.views) {
    const auto at = std::find(frames.begin(), frames.end(), view.frame);
    const auto frame = static_cast<int>(at - frames.begin());
    if (at == frames.end()) frames.push_back(view.frame);
    for (const ImageCorner& corner : view.corners) {
      if (corner.point < 0 || corner.point >= target.size())
        bad_input({view.image}, "corner {} is not on the target", corner.point);
      out.corners.push_back(
          {camera_of[static_cast<std::size_t>(view.camera)], frame, corner.point, corner.pixel});
    }
  }
  out.frames = static_cast<int>(frames.size());
  return out;
}

// The corners of one camera, its frames counted anew.
Shot shot_of_camera(const Shot& shot, int camera) {
  Shot out{shot.points_m, shot.bending, {}, 0};
  std::vector<int> frames;
  for (ShotCorner corner : shot.corners) {
    if (corner.camera != camera) continue;
    const auto at = std::find(frames.begin(), frames.end(), corner.frame);
    const auto frame = static_cast<int>(at - frames.begin());
    if (at == frames.end()) frames.push_back(corner.frame);
    corner.frame = frame;
    out.corners.push_back(corner);
  }
  out.frames = static_cast<int>(frames.size());
  return out;
}

std::vector<int> cameras_in(const Shot& shot) {
  std::set<int> out;
  for (const ShotCorner& corner : shot.corners) out.insert(corner.camera);
  return {out.begin(), out.end()};
}

ChiSquareVerdict verdict(const std::string& name, const ShotFit& fit, int free, double least_p) {
  ChiSquareVerdict out{name, fit.chi2, fit.coordinates - free, 0, false};
  out.p = chi_square_tail(out.chi2, out.dof);
  out.holds = out.p >= least_p;
  return out;
}

// Corners of b against the plane through both cameras and the ray of the same corner in a.
RigCheck::Epipolar epipolar(const Rig& rig, const Shot& shot, int a, int b, double sigma_px) {
  const Camera &first = rig.cameras[static_cast<std::size_t>(a)],
               &second = rig.cameras[static_cast<std::size_t>(b)];
  const Pose b_from_a = Pose{second.r_cam_from_rig, second.t_cam_from_rig_m} *
                        Pose{first.r_cam_from_rig, first.t_cam_from_rig_m}.inverse();
  RigCheck::Epipolar out{first.name, second.name, 0, 0, 0};
  const double focal_a = 0.5 * (first.parameters[0] + first.parameters[1]),
               focal_b = 0.5 * (second.parameters[0] + second.parameters[1]);
  double squared = 0;
  for (const ShotCorner& one : shot.corners) {
    if (one.camera != a) continue;
    for (const ShotCorner& other : shot.corners) {
      if (other.camera != b || other.frame != one.frame || other.point != one.point) continue;
      const auto ray_a = unproject(first, one.pixel), ray_b = unproject(second, other.pixel);
      if (!ray_a || !ray_b) continue;
      const Eigen::Vector3d normal = b_from_a.t_m.cross(b_from_a.r * *ray_a);
      squared += std::pow(focal_b * std::asin(std::clamp(normal.normalized().dot(*ray_b), -1.0, 1.0)), 2);
      ++out.corners;
    }
  }
  if (out.corners > 0) out.rms_px = std::sqrt(squared / out.corners);
  out.expected_px = sigma_px * std::hypot(1.0, focal_b / focal_a);
  return out;
}

// Free numbers of a fit: those that only the shot determines.
int free_numbers(const Shot& shot, const ShotFitOptions& how) {
  return 6 * shot.frames + (how.bending ? 2 : 0) + (how.scale ? 1 : 0);
}

// Two cameras of one size whose images, exchanged, fit far better.
std::string exchanged_cameras(const Rig& rig, const RigErrors& errors, const Shot& shot,
                              const ShotFitOptions& how, double chi2) {
  constexpr double far_better = 0.1;
  const std::vector<int> seen = cameras_in(shot);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (std::size_t j = i + 1; j < seen.size(); ++j) {
      const Camera &a = rig.cameras[static_cast<std::size_t>(seen[i])],
                   &b = rig.cameras[static_cast<std::size_t>(seen[j])];
      if (a.width_px != b.width_px || a.height_px != b.height_px) continue;
      Shot other = shot;
      for (ShotCorner& corner : other.corners)
        corner.camera = corner.camera == seen[i]   ? seen[j]
                        : corner.camera == seen[j] ? seen[i]
                                                   : corner.camera;
      try {
        if (fit_shot(rig, errors, other, how).chi2 < far_better * chi2) return a.name + " and " + b.name;
      } catch (const Error& error) {  // no board fits: they are not exchanged
        if (error.kind() != ErrorKind::numeric) throw;
      }
    }
  }
  return {};
}

}  // namespace

bool RigCheck::holds() const {
  return rig.holds && (!scale || scale->holds) &&
         std::all_of(cameras.begin(), cameras.end(), [](const ChiSquareVerdict& c) { return c.holds; });
}

// Regularised incomplete gamma function Q(dof/2, chi2/2): series below, continued fraction above the middle
// (Press et al. 2007, 6.2).
double chi_square_tail(double chi2, int dof) {
  if (!(dof > 0) || !(chi2 > 0)) return 1;
  const double a = 0.5 * dof, x = 0.5 * chi2, log_front = a * std::log(x) - x - std::lgamma(a);
  constexpr int most_terms = 100'000;
  constexpr double enough = 1e-15, tiny = 1e-300;
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (int n = 1; n < most_terms && term > enough * sum; ++n) sum += term *= x / (a + n);
    return 1 - std::min(1.0, sum * std::exp(log_front));
  }
  double b = x + 1 - a, c = 1 / tiny, d = 1 / b, h = d;
  for (int n = 1; n < most_terms; ++n) {
    const double an = -n * (n - a);
    b += 2;
    d = an * d + b;
    c = b + an / c;
    d = 1 / (std::abs(d) < tiny ? tiny : d);
    if (std::abs(c) < tiny) c = tiny;
    h *= d * c;
    if (std::abs(d * c - 1) < enough) break;
  }
  return std::exp(log_front) * h;
}

RigCheck check_rig(const Rig& rig, const Observations& observations, const Target& target,
                   const RigCheckOptions& options) {
  const Shot shot = shot_of(rig, observations, target);
  if (shot.corners.empty()) bad_input({}, "no corner of the target in the shot");
  RigCheck out;
  out.corner_sigma_px = options.corner_sigma_px > 0 ? options.corner_sigma_px : rig.residual_sigma_px;
  if (!(out.corner_sigma_px > 0))
    bad_input({}, "the rig has no residual_sigma_px: say how well corners are found (--corner-sigma)");
  out.rig_has_covariance = rig.covariance.has_value();
  const RigErrors errors = rig_errors_of(rig);
  const bool bends = std::any_of(shot.bending.begin(), shot.bending.end(),
                                 [](const Eigen::Vector2d& b) { return !b.isZero(0); });
  ShotFitOptions how{out.corner_sigma_px, options.board_warp && bends, false};
  const ShotFit whole = fit_shot(rig, errors, shot, how);
  out.rig = verdict("rig", whole, free_numbers(shot, how), options.least_p);
  out.residual_rms_px = whole.rms_px;
  const std::vector<int> seen = cameras_in(shot);
  for (const int c : seen) {
    const Shot alone = shot_of_camera(shot, c);
    out.cameras.push_back(verdict(rig.cameras[static_cast<std::size_t>(c)].name,
                                  fit_shot(rig, errors, alone, how), free_numbers(alone, how),
                                  options.least_p));
  }
  if (seen.size() > 1) {
    how.scale = true;
    const ShotFit scaled = fit_shot(rig, errors, shot, how);
    how.scale = false;
    const double z = scaled.log_scale / scaled.log_scale_sigma;
    out.scale = {std::exp(scaled.log_scale), scaled.log_scale_sigma, std::erfc(std::abs(z) / std::sqrt(2.0)),
                 true};
    out.scale->holds = out.scale->p >= options.least_p;
    for (std::size_t i = 0; i < seen.size(); ++i)
      for (std::size_t j = i + 1; j < seen.size(); ++j)
        out.pairs.push_back(epipolar(rig, shot, seen[i], seen[j], out.corner_sigma_px));
  }
  if (!out.rig.holds) out.swapped = exchanged_cameras(rig, errors, shot, how, out.rig.chi2);
  return out;
}

}  // namespace bpms
