#include "calibrate/targets/drawing.h"

namespace bpms {

void draw_bits(const std::vector<std::vector<bool>>& bits, double x, double y, double bit, Drawing& out) {
  for (std::size_t row = 0; row < bits.size(); ++row) {
    std::size_t column = 0;
    while (column < bits[row].size()) {
      if (!bits[row][column]) {
        ++column;
        continue;
      }
      std::size_t end = column;
      while (end < bits[row].size() && bits[row][end]) ++end;
      out.black.push_back({x + bit * static_cast<double>(column), y + bit * static_cast<double>(row),
                           bit * static_cast<double>(end - column), bit});
      column = end;
    }
  }
}

}  // namespace bpms
