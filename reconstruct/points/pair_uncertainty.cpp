#include "reconstruct/points/pair_uncertainty.h"

#include <Eigen/Geometry>

#include "reconstruct/points/rig_errors.h"
#include "reconstruct/points/triangulation.h"

namespace bpms {
namespace {

struct SharedAxis {
  Eigen::Vector3d middle_m;
  Eigen::Matrix3d directions;  // columns x, y, z, in the rig's frame
};

std::optional<SharedAxis> shared_axis(const Camera& a, const Camera& b) {
  const auto centre = [](const Camera& c) -> Eigen::Vector3d {
    return -(c.r_cam_from_rig.transpose() * c.t_cam_from_rig_m);
  };
  const Eigen::Vector3d baseline = centre(b) - centre(a);
  const Eigen::Vector3d along = a.r_cam_from_rig.row(2).transpose() + b.r_cam_from_rig.row(2).transpose();
  constexpr double opposed = 1e-6;
  if (along.norm() < opposed) return std::nullopt;
  const Eigen::Vector3d z = along.normalized();
  const Eigen::Vector3d across = baseline - baseline.dot(z) * z;
  // One behind the other tells no depth on the axis.
  if (!(across.norm() > opposed * std::max(baseline.norm(), opposed))) return std::nullopt;
  SharedAxis out{0.5 * (centre(a) + centre(b)), {}};
  out.directions.col(2) = z;
  out.directions.col(0) = across.normalized();
  out.directions.col(1) = z.cross(out.directions.col(0));
  return out;
}

// Where the point is in the camera's image, if it is.
std::optional<Sighting> sighting_of(const Rig& rig, int camera, const Eigen::Vector3d& x_rig,
                                    double sigma_px) {
  const Camera& c = rig.cameras[static_cast<std::size_t>(camera)];
  const auto pixel = project(c, c.camera_from_rig(x_rig));
  if (!pixel || pixel->minCoeff() < -0.5 || pixel->x() > c.width_px - 0.5 || pixel->y() > c.height_px - 0.5)
    return std::nullopt;
  return Sighting{camera, *pixel, sigma_px};
}

}  // namespace

std::vector<PairUncertainty> pair_uncertainty(const Rig& rig, int a, int b, double sigma_px,
                                              const std::vector<double>& ranges_m) {
  std::vector<PairUncertainty> out;
  const auto axis =
      shared_axis(rig.cameras[static_cast<std::size_t>(a)], rig.cameras[static_cast<std::size_t>(b)]);
  if (!axis) return out;
  const RigErrors errors(rig);
  const auto sigmas = [&](const Eigen::Matrix3d& covariance) -> Eigen::Vector3d {
    return (axis->directions.transpose() * covariance * axis->directions).diagonal().cwiseSqrt();
  };
  for (const double range_m : ranges_m) {
    const Eigen::Vector3d x_rig = axis->middle_m + range_m * axis->directions.col(2);
    const auto in_a = sighting_of(rig, a, x_rig, sigma_px), in_b = sighting_of(rig, b, x_rig, sigma_px);
    if (!in_a || !in_b) continue;
    const Triangulation found = triangulate({*in_a, *in_b}, rig);
    if (!found.failure.empty()) continue;
    Eigen::Matrix3d total = found.covariance_m2;
    if (errors.size() > 0) {
      const Eigen::MatrixXd by_rig =
          found.covariance_m2 * found.by_point.transpose() * errors.by_rig({*in_a, *in_b}, found.projections);
      total += by_rig * errors.covariance() * by_rig.transpose();
    }
    out.push_back({range_m, sigmas(found.covariance_m2), sigmas(total)});
  }
  return out;
}

}  // namespace bpms
