#include "calibrate/targets/charuco_detector.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <optional>

#include "calibrate/adjustment/homography.h"
#include "calibrate/targets/marker_dictionary.h"
#include "calibrate/targets/refine_corners.h"

namespace bpms {
namespace {

struct PlacedMarker {
  std::vector<Eigen::Vector2d> board, image;  // its four corners
};

// The two squares with markers that touch an inner corner: above and below it.
std::array<std::pair<int, int>, 2> marker_squares(const Target& target, int row, int column) {
  if (charuco_marker_id(target, row, column) >= 0) return {{{row, column}, {row + 1, column + 1}}};
  return {{{row, column + 1}, {row + 1, column}}};
}

std::map<int, PlacedMarker> placed_markers(const cv::Mat& grey, const Target& target, Detection& out) {
  std::map<int, std::pair<int, int>> squares;
  for (int row = 0; row < target.rows; ++row) {
    for (int column = 0; column < target.columns; ++column) {
      const int id = charuco_marker_id(target, row, column);
      if (id >= 0) squares.emplace(id, std::pair(row, column));
    }
  }
  std::map<int, PlacedMarker> placed;
  std::map<int, int> times;
  for (const SeenMarker& seen : find_markers(grey, target.dictionary)) {
    const auto square = squares.find(seen.id);
    if (square == squares.end()) continue;
    ++times[seen.id];
    PlacedMarker marker;
    const Eigen::Vector2d at = charuco_marker_corner(target, square->second.first, square->second.second);
    for (const Eigen::Vector2d& step : {Eigen::Vector2d(0, 0), {1, 0}, {1, 1}, {0, 1}})
      marker.board.push_back(at + target.mark_m * step);
    marker.image.assign(seen.corners.begin(), seen.corners.end());
    placed[seen.id] = marker;
  }
  for (const auto& [id, count] : times) {
    if (count == 1) continue;
    out.remarks.push_back(fmt::format("marker {} is in the image {} times and left out", id, count));
    placed.erase(id);
  }
  return placed;
}

struct Expected {
  Eigen::Vector2d pixel;
  double spacing_px = 0;  // to the nearest neighbour
};

// Where the markers on both sides of a corner have it; nothing when one is missing or they disagree.
std::optional<Expected> expected_corner(const Eigen::Vector2d& corner, double square, const PlacedMarker& a,
                                        const PlacedMarker& b) {
  std::vector<Eigen::Vector2d> board = a.board, image = a.image;
  board.insert(board.end(), b.board.begin(), b.board.end());
  image.insert(image.end(), b.image.begin(), b.image.end());
  const auto both = homography(board, image), from_a = homography(a.board, a.image),
             from_b = homography(b.board, b.image);
  if (!both || !from_a || !from_b) return std::nullopt;
  const auto at = [](const Eigen::Matrix3d& h, const Eigen::Vector2d& x) -> Eigen::Vector2d {
    return (h * x.homogeneous()).hnormalized();
  };
  Expected out{at(*both, corner), HUGE_VAL};
  for (const Eigen::Vector2d& step : {Eigen::Vector2d(1, 0), {-1, 0}, {0, 1}, {0, -1}})
    out.spacing_px = std::min(out.spacing_px, (at(*both, corner + square * step) - out.pixel).norm());
  constexpr double agree_of_spacing = 0.25;
  if (!((at(*from_a, corner) - at(*from_b, corner)).norm() < agree_of_spacing * out.spacing_px))
    return std::nullopt;
  return out;
}

}  // namespace

int charuco_marker_id(const Target& target, int row, int column) {
  const auto black = [&](int r, int c) { return (r + c + (target.first_square_white ? 1 : 0)) % 2 == 0; };
  if (black(row, column)) return -1;
  int before = 0;  // white squares above, and left of it
  for (int r = 0; r < row; ++r) before += (target.columns + (black(r, 0) ? 0 : 1)) / 2;
  for (int c = 0; c < column; ++c) before += black(row, c) ? 0 : 1;
  return target.first_id + before;
}

Eigen::Vector2d charuco_marker_corner(const Target& target, int row, int column) {
  const double margin = (target.square_m - target.mark_m) / 2;
  return {(column - 1) * target.square_m + margin, (row - 1) * target.square_m + margin};
}

Detection find_charuco(const cv::Mat& grey, const Target& target) {
  Detection out;
  const std::map<int, PlacedMarker> markers = placed_markers(grey, target, out);
  const double white_of_square = (target.square_m - target.mark_m) / 2 / target.square_m;
  int moved = 0;
  for (int row = 0; row + 1 < target.rows; ++row) {
    for (int column = 0; column + 1 < target.columns; ++column) {
      const auto squares = marker_squares(target, row, column);
      const auto a = markers.find(charuco_marker_id(target, squares[0].first, squares[0].second));
      const auto b = markers.find(charuco_marker_id(target, squares[1].first, squares[1].second));
      if (a == markers.end() || b == markers.end()) continue;
      const auto expected = expected_corner({column * target.square_m, row * target.square_m},
                                            target.square_m, a->second, b->second);
      if (!expected) {
        ++moved;
        continue;
      }
      std::vector<cv::Point2f> corner{
          cv::Point2f(static_cast<float>(expected->pixel.x()), static_cast<float>(expected->pixel.y()))};
      // 0.4 of what is free stays short of the marker's edge.
      constexpr double window_of_free = 0.4;
      refine_corners(grey, std::min(1.0, white_of_square / window_of_free) * expected->spacing_px, corner);
      const Eigen::Vector2d pixel(corner[0].x, corner[0].y);
      constexpr double near_px = 1.5, near_of_spacing = 0.1;
      if ((pixel - expected->pixel).norm() > std::max(near_px, near_of_spacing * expected->spacing_px)) {
        ++moved;
        continue;
      }
      out.corners.push_back({row * (target.columns - 1) + column, pixel});
    }
  }
  if (moved > 0)
    out.remarks.push_back(
        fmt::format("{} corners lie elsewhere than the markers have them and are left out", moved));
  if (!out.found())
    out.trouble = markers.empty() ? "none of the board's markers found" : "no corner of the board found";
  return out;
}

}  // namespace bpms
