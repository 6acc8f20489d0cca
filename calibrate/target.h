// Calibration targets: known points on a board. Board frame: x along a row, y down the columns, z away from a
// viewer who faces the board; the first corner is the origin. Metres.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace bpms {

struct Target {
  std::string kind = "chessboard";
  int columns = 0;  // inner corners in a row
  int rows = 0;
  double square_m = 0;

  int size() const { return columns * rows; }
  std::vector<Eigen::Vector3d> points_m() const;  // row by row
  // (1 - x^2, 1 - y^2) of each point with x, y in [-1, 1] over the board: the shape of its two bending terms.
  std::vector<Eigen::Vector2d> bending() const;
};

// "chessboard:9x6:25mm", or the path of a board.toml.
Target parse_target(const std::string& text);
Target read_board(const std::string& path);
std::string board_toml(const Target& target);

}  // namespace bpms
