// Where in its image a camera's calibration is to be trusted: the convex hull of the corners seen there.
#pragma once
#include <vector>

#include "calibrate/observations.h"

namespace bpms {

// Corners of the smallest convex polygon around the points, counter-clockwise in a frame of x right, y up.
std::vector<Eigen::Vector2d> hull_of_pixels(std::vector<Eigen::Vector2d> points);
bool inside_hull(const std::vector<Eigen::Vector2d>& hull, const Eigen::Vector2d& point);
// Of one camera, in pixels; empty where it saw nothing.
std::vector<Eigen::Vector2d> valid_region(const Observations& observations, int camera);

}  // namespace bpms
