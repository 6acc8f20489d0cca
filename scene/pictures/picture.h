// Pictures of plants, canopies and scenes without any simulation of light: views side by side, each in the
// colours of its parts, with a bar of known length and a legend. The same input gives the same bytes.
#pragma once
#include <string>
#include <vector>

#include "core/png.h"
#include "scene/pictures/colouring.h"
#include "scene/pictures/picture_camera.h"

namespace bpms {

struct PictureOptions {
  std::vector<PictureView> views;  // one panel each, from the left
  int width = 0, height = 0;       // of the whole; 0: chosen by the number of views
  double fov_deg = 0;              // 0: orthographic, all views at one scale
  std::string colour = "material";
  bool transparent = false;  // the background; else white
  bool legend = true, scale_bar = true, labels = true;
  int samples = 16;  // rays a pixel
};

// Where things lie on the picture, for reports and tests.
struct PicturePanel {
  PictureView view;
  int left = 0, top = 0, width = 0, height = 0;  // of what was drawn of the scene
  double metres_per_pixel = 0;                   // perspective: in the plane through the scene's middle
  double bar_m = 0, bar_left = 0, bar_top = 0;   // the scale bar: its length and its upper left corner
};
struct Picture {
  RgbImage image;
  std::vector<PicturePanel> panels;
  Colouring colouring;
};

// Of a scene as picture_subject() makes it.
Picture draw_picture(const Scene& scene, const PictureOptions& options);

// The largest of 1, 2, 5 times a power of ten that is not above the value; a length in words, "5 cm".
double nice_below(double value);
std::string length_in_words(double metres);

}  // namespace bpms
