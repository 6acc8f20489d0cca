#include "calibrate/targets/circle_detector.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>

#include "calibrate/adjustment/homography.h"

namespace bpms {
namespace {

using Points = std::vector<Eigen::Vector2d>;

Points find_grid(const cv::Mat& grey, const CircleGrid& grid) {
  std::vector<cv::Point2f> found;
  const int layout = grid.asymmetric ? cv::CALIB_CB_ASYMMETRIC_GRID : cv::CALIB_CB_SYMMETRIC_GRID;
  cv::SimpleBlobDetector::Params blobs;  // the default gives up circles above 5000 pixels in area
  constexpr float smallest_px2 = 20;
  blobs.minArea = smallest_px2;
  blobs.maxArea = static_cast<float>(grey.total()) / static_cast<float>(grid.columns * grid.rows);
  const auto detector = cv::SimpleBlobDetector::create(blobs);
  const cv::Size size(grid.columns, grid.rows);
  for (const int clustering : {0, static_cast<int>(cv::CALIB_CB_CLUSTERING)}) {
    if (!cv::findCirclesGrid(grey, size, found, layout | clustering, detector)) continue;
    if (found.size() != grid.centres_m.size()) continue;
    Points out;
    for (const cv::Point2f& p : found) out.emplace_back(p.x, p.y);
    return out;
  }
  return {};
}

// The order in which a camera can see the board (not turned over) and that fits best.
bool put_circles_in_order(const CircleGrid& grid, Points& points) {
  Points best;
  double least = HUGE_VAL;
  for (const bool rows_turned : {false, true}) {
    for (const bool columns_turned : {false, true}) {
      Points trial;
      for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column) {
          const int r = rows_turned ? grid.rows - 1 - row : row,
                    c = columns_turned ? grid.columns - 1 - column : column;
          trial.push_back(points[static_cast<std::size_t>(r * grid.columns + c)]);
        }
      }
      const auto h = homography(grid.centres_m, trial);
      if (!h) continue;
      const Eigen::Vector3d middle = *h * grid.centres_m[grid.centres_m.size() / 2].homogeneous();
      if (h->determinant() * middle.z() < 0) continue;  // turned over
      double sum = 0;
      for (std::size_t i = 0; i < trial.size(); ++i)
        sum += ((*h * grid.centres_m[i].homogeneous()).hnormalized() - trial[i]).squaredNorm();
      constexpr double clearly = 0.99;  // of equals the first stays
      if (sum < clearly * least) least = sum, best = trial;
    }
  }
  if (best.empty()) return false;
  points = best;
  return true;
}

// Paper around a circle: a plane of grey values, fitted to the rim of a window.
Eigen::Vector3d paper(const cv::Mat& grey, const Eigen::Vector2d& at, double radius_px) {
  constexpr double rim_px = 2;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const int reach = static_cast<int>(std::ceil(radius_px));
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const int x = cvRound(at.x()) + dx, y = cvRound(at.y()) + dy;
      const Eigen::Vector2d off(x - at.x(), y - at.y());
      if (x < 0 || y < 0 || x >= grey.cols || y >= grey.rows || off.norm() > radius_px ||
          off.norm() < radius_px - rim_px)
        continue;
      const Eigen::Vector3d row(1, off.x(), off.y());
      normal += row * row.transpose();
      right += row * static_cast<double>(grey.at<unsigned char>(y, x));
    }
  }
  return normal.ldlt().solve(right);
}

Eigen::Vector2d centroid(const cv::Mat& grey, const Eigen::Vector2d& at, double radius_px) {
  const Eigen::Vector3d plane = paper(grey, at, radius_px);
  double mass = 0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  const int reach = static_cast<int>(std::ceil(radius_px));
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const int x = cvRound(at.x()) + dx, y = cvRound(at.y()) + dy;
      const Eigen::Vector2d off(x - at.x(), y - at.y());
      if (x < 0 || y < 0 || x >= grey.cols || y >= grey.rows || off.norm() > radius_px) continue;
      const double dark =
          plane.dot(Eigen::Vector3d(1, off.x(), off.y())) - static_cast<double>(grey.at<unsigned char>(y, x));
      mass += dark;
      moment += dark * off;
    }
  }
  return mass > 0 ? Eigen::Vector2d(at + moment / mass) : at;
}

// Half the way to the nearest other circle: the window holds all of a circle and only white besides.
double window_px(const Points& points, std::size_t i) {
  double nearest = HUGE_VAL;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (k != i) nearest = std::min(nearest, (points[k] - points[i]).norm());
  }
  return nearest / 2;
}

void refine_circles(const cv::Mat& grey, Points& points) {
  const Points start = points;
  constexpr int steps = 3;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double window = window_px(start, i);
    for (int step = 0; step < steps; ++step) points[i] = centroid(grey, points[i], window);
  }
}

// The homography itself is fitted to places that are off by what it is to tell; a second round settles it.
void undo_perspective(const CircleGrid& grid, Points& points) {
  const Points seen = points;
  for (int round = 0; round < 2; ++round) {
    const auto h = homography(grid.centres_m, points);
    if (!h) return;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector2d middle = (*h * grid.centres_m[i].homogeneous()).hnormalized();
      points[i] = seen[i] - (middle_of_circle_image(*h, grid.centres_m[i], grid.radius_m) - middle);
    }
  }
}

}  // namespace

Eigen::Vector2d middle_of_circle_image(const Eigen::Matrix3d& homography, const Eigen::Vector2d& centre,
                                       double radius) {
  const Eigen::Vector3d c = centre.homogeneous();
  Eigen::Matrix3d dual = c * c.transpose();
  dual(0, 0) -= radius * radius;
  dual(1, 1) -= radius * radius;
  const Eigen::Matrix3d image = homography * dual * homography.transpose();
  return image.col(2).hnormalized();
}

std::optional<std::vector<Eigen::Vector2d>> find_circles(const cv::Mat& grey, const CircleGrid& grid) {
  Points points = find_grid(grey, grid);
  if (points.empty() || !put_circles_in_order(grid, points)) return std::nullopt;
  refine_circles(grey, points);
  undo_perspective(grid, points);
  return points;
}

}  // namespace bpms
