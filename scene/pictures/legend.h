// The legend beside a picture: a swatch for each category, or a bar of colours with its numbers.
#pragma once
#include <string>
#include <vector>

#include "scene/pictures/canvas.h"
#include "scene/pictures/colouring.h"

namespace bpms {

class Legend {
 public:
  Legend(const Colouring& colouring, int picture_height);
  int width() const { return width_; }
  void draw(int left, int top, Canvas& canvas) const;

 private:
  const Colouring& colouring_;
  std::vector<Colouring::Entry> entries_;  // that there is room for
  std::vector<std::string> ticks_;         // from the top
  int width_ = 0, bar_height_ = 0;
};

// Numbers at equal steps over [low, high], as short as tells them apart.
std::vector<std::string> tick_labels(double low, double high, int count);

}  // namespace bpms
