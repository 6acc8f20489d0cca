// Homographies of a plane: direct linear transform with normalised coordinates (Hartley & Zisserman
// 2004, 4.4).
#pragma once
#include <optional>
#include <vector>

#include "calibrate/pose.h"

namespace bpms {

// q ~ H (x, y, 1); nullopt for fewer than 4 points or points on a line.
std::optional<Eigen::Matrix3d> homography(const std::vector<Eigen::Vector2d>& plane,
                                          const std::vector<Eigen::Vector2d>& image);
// The pose of the plane z = 0 from a homography onto the normalised image plane (x/z, y/z), plane in front.
Pose pose_from_homography(const Eigen::Matrix3d& h);

}  // namespace bpms
