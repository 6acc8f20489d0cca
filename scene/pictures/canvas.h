// A sheet of pixels that shapes and text are laid onto. Pixel (0, 0) covers [0, 1) x [0, 1), y down. Colours
// are mixed as they are stored (sRGB), with opacity.
#pragma once
#include <string_view>
#include <vector>

#include "core/png.h"
#include "scene/pictures/colours.h"
#include "scene/pictures/stroke_font.h"

namespace bpms {

class Canvas {
 public:
  Canvas(int width, int height);  // clear: nothing on it
  int width() const { return width_; }
  int height() const { return height_; }

  void fill(const Rgb& colour);  // all of it
  void over(int x, int y, const Rgb& colour, double opacity);
  // Edges need not lie on those of pixels.
  void rectangle(double left, double top, double right, double bottom, const Rgb& colour);
  void strokes(const std::vector<Stroke>& strokes, double pen, const Rgb& colour);  // pen: diameter
  void text(std::string_view utf8, const Eigen::Vector2d& base_left, double cap_height, const Rgb& colour);

  RgbImage image() const;  // with alpha where any pixel is not opaque

 private:
  int width_, height_;
  std::vector<float> colour_;  // four a pixel, multiplied by the fourth, the opacity
};

}  // namespace bpms
