// Poses of targets from single views, without a start: from a homography where the points lie in a plane, by
// the direct linear transform where they do not (Hartley & Zisserman 2004, 7.1).
#pragma once
#include <optional>
#include <vector>

#include "calibrate/pose.h"

namespace bpms {

struct PointPair {
  Eigen::Vector3d on_target_m;
  Eigen::Vector2d image;  // pixels from the image's centre, or x/z and y/z
};

// What one view says by itself, with square pixels and the principal point at the image's centre.
struct ViewProjection {
  bool flat = true;
  Eigen::Matrix3d homography;              // of a flat target: from the coordinates in its plane
  Pose plane_from_target;                  // which is this: z = 0
  Eigen::Matrix<double, 3, 4> projection;  // of one that is not flat
};
// nullopt where too few points, or points on a line, decide nothing.
std::optional<ViewProjection> view_projection(const std::vector<PointPair>& points);
// Focal length in pixels and how much the view knows of it; nullopt where it says nothing.
struct FocalVote {
  double inverse_square = 0;  // 1/f^2
  double weight = 0;
};
std::optional<FocalVote> focal_vote(const ViewProjection& view);
Pose camera_from_target(const ViewProjection& view, double focal_px);

}  // namespace bpms
