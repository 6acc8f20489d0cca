// What is printed of a target: black shapes on white, in metres in the board's frame (x right, y down).
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace bpms {

struct Drawing {
  struct Rectangle {
    double x = 0, y = 0, width = 0, height = 0;  // from its upper left corner
  };
  struct Disc {
    double x = 0, y = 0, radius = 0;
  };
  std::vector<Rectangle> black;  // none overlaps another
  std::vector<Disc> discs;
  // Nothing else may be printed inside: the shapes and the white that they need around them.
  Eigen::Vector2d quiet_low = Eigen::Vector2d::Zero(), quiet_high = Eigen::Vector2d::Zero();
  std::string caption;
};

// Squares of side `bit` where `bits` (rows of a square matrix) is set, neighbours in a row joined.
void draw_bits(const std::vector<std::vector<bool>>& bits, double x, double y, double bit, Drawing& out);

}  // namespace bpms
