#include "calibrate/adjustment/view_pose.h"

#include <Eigen/Dense>
#include <cmath>

#include "calibrate/adjustment/homography.h"

namespace bpms {
namespace {

constexpr double flatness = 1e-3;  // of the target's extent: what rises less counts as a plane

// The plane that the points lie in best: its x and y are the axes of greatest extent.
Pose best_plane(const std::vector<PointPair>& points, Eigen::Vector3d& extent) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  const double n = static_cast<double>(points.size());
  for (const PointPair& p : points) centre += p.on_target_m / n;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const PointPair& p : points)
    scatter += (p.on_target_m - centre) * (p.on_target_m - centre).transpose() / n;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
  extent = eigen.eigenvalues().reverse().cwiseMax(0).cwiseSqrt();
  Eigen::Matrix3d r;
  r.row(0) = eigen.eigenvectors().col(2).transpose();
  r.row(1) = eigen.eigenvectors().col(1).transpose();
  r.row(2) = r.row(0).cross(r.row(1));
  return {r, -r * centre};
}

// x ~ P X with both sides normalised.
std::optional<Eigen::Matrix<double, 3, 4>> linear_projection(const std::vector<PointPair>& points) {
  constexpr std::size_t fewest = 6;
  if (points.size() < fewest) return std::nullopt;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double size = 0, image = 0;
  const double n = static_cast<double>(points.size());
  for (const PointPair& p : points) centre += p.on_target_m / n;
  for (const PointPair& p : points) size += (p.on_target_m - centre).norm() / n, image += p.image.norm() / n;
  if (!(size > 0 && image > 0)) return std::nullopt;
  Eigen::Matrix<double, 12, 12> normal = Eigen::Matrix<double, 12, 12>::Zero();
  for (const PointPair& p : points) {
    Eigen::Vector4d x;
    x << (p.on_target_m - centre) / size, 1;
    const Eigen::Vector2d q = p.image / image;
    Eigen::Matrix<double, 2, 12> rows = Eigen::Matrix<double, 2, 12>::Zero();
    rows.block<1, 4>(0, 0) = rows.block<1, 4>(1, 4) = x.transpose();
    rows.block<1, 4>(0, 8) = -q.x() * x.transpose();
    rows.block<1, 4>(1, 8) = -q.y() * x.transpose();
    normal += rows.transpose() * rows;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 12, 12>> eigen(normal);
  constexpr double rank = 1e-10;
  if (!(eigen.eigenvalues()[1] > rank * eigen.eigenvalues()[11])) return std::nullopt;
  const Eigen::Matrix<double, 12, 1> v = eigen.eigenvectors().col(0);
  Eigen::Matrix<double, 3, 4> p;
  p << v.segment<4>(0).transpose(), v.segment<4>(4).transpose(), v.segment<4>(8).transpose();
  Eigen::Matrix4d moved = Eigen::Matrix4d::Identity();
  moved.topLeftCorner<3, 3>() /= size;
  moved.topRightCorner<3, 1>() = -centre / size;
  p = (Eigen::Vector3d(image, image, 1).asDiagonal() * p * moved).eval();
  return p;
}

}  // namespace

std::optional<ViewProjection> view_projection(const std::vector<PointPair>& points) {
  if (points.size() < 4) return std::nullopt;
  ViewProjection out;
  Eigen::Vector3d extent;
  out.plane_from_target = best_plane(points, extent);
  out.flat = extent[2] < flatness * extent[0];
  if (!out.flat) {
    const auto p = linear_projection(points);
    if (!p) return std::nullopt;
    out.projection = *p;
    return out;
  }
  std::vector<Eigen::Vector2d> plane, image;
  for (const PointPair& p : points) {
    plane.push_back((out.plane_from_target * p.on_target_m).head<2>());
    image.push_back(p.image);
  }
  const auto h = homography(plane, image);
  if (!h) return std::nullopt;
  out.homography = *h;
  return out;
}

// A flat target gives two conditions on a rotation's columns, a (h1x h2x + h1y h2y) + h1z h2z = 0 and the
// same of |h1|^2 - |h2|^2, with a = 1/f^2 (Zhang 2000). Of a projection the rows are f r1, f r2, r3 times a
// scale.
std::optional<FocalVote> focal_vote(const ViewProjection& view) {
  if (!view.flat) {
    const Eigen::Matrix3d m = view.projection.leftCols<3>();
    const double third = m.row(2).squaredNorm();
    const double square = 0.5 * (m.row(0).squaredNorm() + m.row(1).squaredNorm()) / third;
    if (!(square > 0) || !std::isfinite(square)) return std::nullopt;
    return FocalVote{1 / square, 1};
  }
  const Eigen::Matrix3d& h = view.homography;
  const Eigen::Vector3d h1 = h.col(0) / h.col(0).norm(), h2 = h.col(1) / h.col(0).norm();
  const Eigen::Vector2d c(h1.head<2>().dot(h2.head<2>()),
                          h1.head<2>().squaredNorm() - h2.head<2>().squaredNorm());
  const Eigen::Vector2d d(h1.z() * h2.z(), h1.z() * h1.z() - h2.z() * h2.z());
  if (!(c.squaredNorm() > 0)) return std::nullopt;
  return FocalVote{-c.dot(d) / c.squaredNorm(), c.squaredNorm()};
}

Pose camera_from_target(const ViewProjection& view, double focal_px) {
  const Eigen::DiagonalMatrix<double, 3> normalise(1 / focal_px, 1 / focal_px, 1);
  if (view.flat) return pose_from_homography(normalise * view.homography) * view.plane_from_target;
  const Eigen::Matrix<double, 3, 4> p = normalise * view.projection;
  const Eigen::Matrix3d m = p.leftCols<3>();
  const double scale = std::cbrt(m.determinant());  // with the sign that makes it a rotation
  return {orthonormalised(m / scale), p.col(3) / scale};
}

}  // namespace bpms
