#include "reconstruct/points/disparity_check.h"

#include <algorithm>
#include <cmath>

#include "core/statistics.h"
#include "reconstruct/photograph.h"

namespace bpms {
namespace {

struct Rectified {
  int left, right;
  double focal_px, baseline_m, offset_px;
};

Rectified rectified_pair(const Rig& rig) {
  if (rig.cameras.size() != 2)
    bad_input({}, "--check-disparity needs a rectified pair; the rig has {} cameras", rig.cameras.size());
  const Camera *left = &rig.cameras[0], *right = &rig.cameras[1];
  // The left camera stands at the smaller x: the other's origin lies at +B in its frame.
  const Eigen::Vector3d apart = left->t_cam_from_rig_m - right->t_cam_from_rig_m;
  if (apart.x() < 0) std::swap(left, right);
  const auto refuse = [](const char* what) {
    bad_input({}, "--check-disparity needs a rectified pair; {}", what);
  };
  constexpr double same = 1e-9;
  const auto &a = left->parameters, &b = right->parameters;
  for (const auto& parameters : {a, b}) {
    if (std::any_of(parameters.begin() + 4, parameters.end(), [](double k) { return k != 0; }))
      refuse("a camera has lens distortion");
  }
  if (std::abs(a[0] - b[0]) > same * a[0]) refuse("the focal lengths differ");
  if (std::abs(a[3] - b[3]) > same * a[0]) refuse("the cy differ");
  if ((left->r_cam_from_rig - right->r_cam_from_rig).cwiseAbs().maxCoeff() > same)
    refuse("the rotations differ");
  const double baseline = apart.norm();
  if (std::abs(apart.x()) < (1 - same) * baseline || baseline == 0) refuse("the baseline is not along x");
  return {static_cast<int>(left - rig.cameras.data()), static_cast<int>(right - rig.cameras.data()), a[0],
          baseline, b[2] - a[2]};
}

}  // namespace

DisparityCheck check_disparity(const std::string& map_path, const Vectors& vectors, const Rig& rig) {
  const Rectified pair = rectified_pair(rig);
  const Camera& left = rig.cameras[static_cast<std::size_t>(pair.left)];
  const GreyImage map = read_grey_image(map_path);
  if (map.width != left.width_px || map.height != left.height_px)
    bad_input({map_path}, "the disparity map has {}x{} pixels, camera '{}' {}x{}", map.width, map.height,
              left.name, left.width_px, left.height_px);
  DisparityCheck out;
  std::vector<double> ratios, depths;
  for (const ReconstructedPoint& p : vectors.points) {
    if (!p.estimate) continue;
    const auto seen = std::find_if(p.sightings.begin(), p.sightings.end(),
                                   [&](const Sighting& s) { return s.camera == pair.left; });
    if (seen == p.sightings.end()) continue;
    const auto u = std::clamp(static_cast<int>(std::lround(seen->pixel.x())), 0, map.width - 1);
    const auto v = std::clamp(static_cast<int>(std::lround(seen->pixel.y())), 0, map.height - 1);
    const double d = map.at(u, v);
    if (d == 0) {
      ++out.unknown;
      continue;
    }
    const double truth = pair.focal_px * pair.baseline_m / (d + pair.offset_px);
    const Eigen::RowVector3d axis = left.r_cam_from_rig.row(2);
    const double dz = left.camera_from_rig(p.estimate->x_m).z() - truth;
    const double sigma = std::sqrt((axis * p.estimate->covariance_m2() * axis.transpose()).value());
    out.points.push_back({p.str(), dz, sigma, std::abs(dz) / sigma, !p.accepted()});
    if (!p.accepted()) continue;
    ratios.push_back(std::abs(dz) / sigma);
    depths.push_back(std::abs(dz));
  }
  out.median_ratio = median(ratios);
  out.median_abs_dz_m = median(depths);
  return out;
}

}  // namespace bpms
