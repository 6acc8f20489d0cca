#include "fit/synthetic.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "plant/leaf_frame.h"

namespace bpms {
namespace {

std::vector<double> uneven_places(int count, bool with_ends, Philox& random) {
  std::vector<double> out;
  constexpr double jitter = 0.3;  // of the step
  for (int k = 0; k < count; ++k) {
    const double middle = with_ends ? k / (count - 1.0) : (k + 0.5) / count;
    const bool end = with_ends && (k == 0 || k == count - 1);
    out.push_back(end ? middle : middle + jitter / count * random.uniform(-1, 1));
  }
  return out;
}

VectorPoint noisy(const Eigen::Vector3d& truth, const SyntheticNoise& noise, int number,
                  const std::string& feature, Philox& random) {
  VectorPoint out;
  out.label = {"1", "1", 1, "leaf", feature};
  out.point = number;
  // The line of sight differs from point to point, so that the covariances do.
  Eigen::Vector3d sight(random.normal(), random.normal(), random.normal());
  sight.normalize();
  const double across = noise.sigma_m > 0 ? noise.sigma_m : noise.stated_m;
  const Eigen::Matrix3d covariance =
      across * across *
      (Eigen::Matrix3d::Identity() + (noise.depth_ratio * noise.depth_ratio - 1) * sight * sight.transpose());
  out.covariance_m2 = noise.stated_ratio * noise.stated_ratio * covariance;
  out.x_m = truth;
  if (noise.sigma_m > 0) {
    const Eigen::Matrix3d root = covariance.llt().matrixL();
    out.x_m += root * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  }
  return out;
}

}  // namespace

MeasuredOrgan measure(const SyntheticLeaf& leaf, const SyntheticNoise& noise, Philox& random) {
  MeasuredOrgan out;
  out.plant = out.axis = "1";
  out.rank = 1;
  out.organ = "leaf";
  out.key = "plant 1 axis 1 rank 1 leaf";
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(leaf.direction, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  int number = 0;
  for (const MidribPoint& p : midrib(leaf.organ, uneven_places(leaf.midrib_points, true, random)))
    out.midrib.push_back(noisy(leaf.base_m + turn * p.x_m, noise, ++number, "midrib", random));
  for (const int side : {1, -1}) {
    if (leaf.edge_points == 0) break;
    std::vector<VectorPoint>& edge = side > 0 ? out.edge_left : out.edge_right;
    number = 0;
    for (const MidribPoint& p : midrib(leaf.organ, uneven_places(leaf.edge_points, false, random))) {
      const double width = leaf.organ.width_m * (leaf.organ.f_width ? leaf.organ.f_width->value(p.l) : 1.0);
      edge.push_back(noisy(leaf.base_m + turn * (p.x_m + side * width / 2 * p.frame.col(1)), noise, ++number,
                           side > 0 ? "edge_left" : "edge_right", random));
    }
  }
  return out;
}

}  // namespace bpms
