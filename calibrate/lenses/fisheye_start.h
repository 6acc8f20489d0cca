// A first guess for a lens of any field of view up to 180 degrees: the straight lines of a board are curves
// in its images, so that homographies of the pixels fail. Focal lengths are tried over a grid; each turns
// pixels into rays (theta = r / f, equidistant), the rays give each board's pose by a homography onto the
// sphere, and the focal length with the least reprojection error is refined.
#pragma once
#include <optional>
#include <vector>

#include "calibrate/pose.h"

namespace bpms {

struct FlatView {                         // of one board in one image
  std::vector<Eigen::Vector3d> points_m;  // in one plane of the target's frame
  std::vector<Eigen::Vector2d> pixels;
};

struct FisheyeStart {
  double focal_px = 0;
  double median_px = 0;                                 // of the reprojection errors
  std::vector<std::optional<Pose>> camera_from_target;  // of each view; none where its points say nothing
};

// The principal point is taken at the image's middle. nullopt when no view gives a pose.
std::optional<FisheyeStart> fisheye_start(const std::vector<FlatView>& views, int width_px, int height_px);

// The pose of a plane z = 0 from unit rays to its points; nullopt for fewer than 4 or points on a line.
std::optional<Pose> pose_from_rays(const std::vector<Eigen::Vector2d>& plane_m,
                                   const std::vector<Eigen::Vector3d>& rays);

}  // namespace bpms
