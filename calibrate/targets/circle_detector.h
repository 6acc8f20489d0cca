// Middles of dark circles on a board. OpenCV finds the grid; each place is then the centroid of what is
// darker than the paper around it. The centroid is that of the circle's image, an ellipse, and the middle of
// the ellipse is not the image of the circle's middle: farther circle, nearer half. The difference follows
// from the homography of the board (dual conics; Heikkilä 2000) and is taken off. What lens distortion adds
// to it within one circle stays in.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

namespace cv {
class Mat;
}

namespace bpms {

struct CircleGrid {
  int columns = 0, rows = 0;
  bool asymmetric = false;
  double radius_m = 0;
  std::vector<Eigen::Vector2d> centres_m;  // row by row
};

// All of them in the order of centres_m, of an 8-bit grey image; nothing when one is missing.
std::optional<std::vector<Eigen::Vector2d>> find_circles(const cv::Mat& grey, const CircleGrid& grid);

// Where the middle of a circle's image lies.
Eigen::Vector2d middle_of_circle_image(const Eigen::Matrix3d& homography, const Eigen::Vector2d& centre,
                                       double radius);

}  // namespace bpms
