#include "calibrate/adjustment/homography.h"

#include <Eigen/Dense>

namespace bpms {
namespace {

// Moves the centroid to the origin and the mean distance to sqrt(2).
Eigen::Matrix3d normaliser(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  for (const auto& p : points) centre += p / static_cast<double>(points.size());
  double distance = 0;
  for (const auto& p : points) distance += (p - centre).norm() / static_cast<double>(points.size());
  const double s = distance > 0 ? std::sqrt(2.0) / distance : 1;
  Eigen::Matrix3d out;
  out << s, 0, -s * centre.x(), 0, s, -s * centre.y(), 0, 0, 1;
  return out;
}

}  // namespace

std::optional<Eigen::Matrix3d> homography(const std::vector<Eigen::Vector2d>& plane,
                                          const std::vector<Eigen::Vector2d>& image) {
  if (plane.size() < 4 || plane.size() != image.size()) return std::nullopt;
  const Eigen::Matrix3d from = normaliser(plane), to = normaliser(image);
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  for (std::size_t i = 0; i < plane.size(); ++i) {
    const Eigen::Vector3d x = from * plane[i].homogeneous(), q = to * image[i].homogeneous();
    Eigen::Matrix<double, 2, 9> rows = Eigen::Matrix<double, 2, 9>::Zero();
    rows.block<1, 3>(0, 0) = rows.block<1, 3>(1, 3) = x.transpose();
    rows.block<1, 3>(0, 6) = -q.x() * x.transpose();
    rows.block<1, 3>(1, 6) = -q.y() * x.transpose();
    normal += rows.transpose() * rows;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> eigen(normal);
  constexpr double rank_tolerance = 1e-10;
  if (!(eigen.eigenvalues()[1] > rank_tolerance * eigen.eigenvalues()[8])) return std::nullopt;
  const Eigen::Matrix<double, 9, 1> h = eigen.eigenvectors().col(0);
  Eigen::Matrix3d out;
  out << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], h[8];
  return to.inverse() * out * from;
}

Pose pose_from_homography(const Eigen::Matrix3d& h) {
  const double scale = std::sqrt(h.col(0).norm() * h.col(1).norm());
  const Eigen::Matrix3d m = h / (h(2, 2) < 0 ? -scale : scale);
  Eigen::Matrix3d r;
  r << m.col(0), m.col(1), m.col(0).cross(m.col(1));
  return {orthonormalised(r), m.col(2)};
}

}  // namespace bpms
