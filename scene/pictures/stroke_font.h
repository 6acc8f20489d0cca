// Letters as strokes on a small grid, drawn with a round pen at any size: enough for labels and numbers.
// Printable ASCII and the signs degree, square, micro and middle dot; anything else is an empty box.
#pragma once
#include <Eigen/Core>
#include <string_view>
#include <vector>

namespace bpms {

struct Stroke {
  Eigen::Vector2d from, to;  // pixels, y down
};
// `cap_height` is the height of a capital letter. `at` is the left end of the base line.
std::vector<Stroke> text_strokes(std::string_view utf8, const Eigen::Vector2d& at, double cap_height);
double text_width(std::string_view utf8, double cap_height);  // from pen to pen, without the pen's own width

}  // namespace bpms
