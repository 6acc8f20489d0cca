// Calibration targets: known points on a board. Board frame: x along a row, y down the columns, z away from a
// viewer who faces the board; the first corner is the origin. Metres.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace bpms {

// A length between two points of a target that was measured by itself.
struct ScaleBar {
  int a = 0, b = 0;  // points
  double length_m = 0, sigma_m = 0;
};

struct Target {
  std::string name = {};  // tells targets apart where there are several
  std::string kind = "chessboard";
  int columns = 0;  // inner corners in a row
  int rows = 0;
  double square_m = 0;
  bool stands = false;  // in one place in all frames (a control frame, a wall), or held anew in each
  // Of each surveyed point, in the target's frame; empty: the points are exact.
  std::vector<Eigen::Matrix3d> covariance_m2 = {};
  std::vector<ScaleBar> scale_bars = {};

  int size() const { return columns * rows; }
  std::vector<Eigen::Vector3d> points_m() const;  // row by row
  // (1 - x^2, 1 - y^2) of each point of a flat board with x, y in [-1, 1] over the board: the shape of its
  // two bending terms. Zeros on what is no flat board.
  std::vector<Eigen::Vector2d> bending() const;
};

// "chessboard:9x6:25mm", or the path of a board.toml.
Target parse_target(const std::string& text);
Target read_board(const std::string& path);
std::string board_toml(const Target& target);

}  // namespace bpms
