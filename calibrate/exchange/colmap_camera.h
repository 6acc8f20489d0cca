// COLMAP's camera models as lenses of calibrate/lenses: parameters in COLMAP's order, with its +0.5 pixel.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/rig.h"

namespace bpms {

struct ColmapLens {
  std::string_view model;  // "OPENCV"
  int id = 0;              // in the binary files
  int parameters = 0;
  bool known = true;  // false: bpms has no such lens
};
const ColmapLens* find_colmap_lens(std::string_view model);
const ColmapLens* find_colmap_lens(int id);
std::string colmap_lens_names();  // those that are read, for messages

// Fills the camera's model and parameters.
void set_colmap_parameters(const ColmapLens& lens, const std::vector<double>& numbers,
                           const SourceLocation& where, Camera& camera);
struct ColmapParameters {
  std::string_view model;
  std::vector<double> numbers;
};
// PINHOLE, OPENCV, FULL_OPENCV or OPENCV_FISHEYE; bad_input for other lenses.
ColmapParameters colmap_parameters(const Camera& camera);

}  // namespace bpms
