#include "calibrate/exchange/colmap_camera.h"

#include <algorithm>
#include <array>

#include "calibrate/exchange/camera_numbers.h"

namespace bpms {
namespace {

constexpr std::array colmap_lenses{
    ColmapLens{"SIMPLE_PINHOLE", 0, 3},
    ColmapLens{"PINHOLE", 1, 4},
    ColmapLens{"SIMPLE_RADIAL", 2, 4},
    ColmapLens{"RADIAL", 3, 5},
    ColmapLens{"OPENCV", 4, 8},
    ColmapLens{"OPENCV_FISHEYE", 5, 8},
    ColmapLens{"FULL_OPENCV", 6, 12},
    ColmapLens{"FOV", 7, 5, false},
    ColmapLens{"SIMPLE_RADIAL_FISHEYE", 8, 4, false},
    ColmapLens{"RADIAL_FISHEYE", 9, 5, false},
    ColmapLens{"THIN_PRISM_FISHEYE", 10, 12, false},
};
constexpr double colmap_half_pixel = 0.5;

}  // namespace

const ColmapLens* find_colmap_lens(std::string_view model) {
  const auto at = std::find_if(colmap_lenses.begin(), colmap_lenses.end(),
                               [&](const ColmapLens& lens) { return lens.model == model; });
  return at == colmap_lenses.end() ? nullptr : &*at;
}

const ColmapLens* find_colmap_lens(int id) {
  const auto at = std::find_if(colmap_lenses.begin(), colmap_lenses.end(),
                               [&](const ColmapLens& lens) { return lens.id == id; });
  return at == colmap_lenses.end() ? nullptr : &*at;
}

std::string colmap_lens_names() {
  std::string out;
  for (const ColmapLens& lens : colmap_lenses)
    if (lens.known) out += (out.empty() ? "" : ", ") + std::string(lens.model);
  return out;
}

void set_colmap_parameters(const ColmapLens& lens, const std::vector<double>& numbers,
                           const SourceLocation& where, Camera& camera) {
  if (!lens.known)
    bad_input(where, "the camera model {} has no counterpart in bpms; read are {}", lens.model,
              colmap_lens_names());
  const std::vector<double>& n = numbers;
  camera.model = lens.model == "OPENCV_FISHEYE" ? "fisheye" : "brown_conrady";
  std::vector<double>& p = camera.parameters;
  if (lens.model == "SIMPLE_PINHOLE")
    p = {n[0], n[0], n[1], n[2]};
  else if (lens.model == "SIMPLE_RADIAL")
    p = {n[0], n[0], n[1], n[2], n[3], 0, 0, 0};
  else if (lens.model == "RADIAL")
    p = {n[0], n[0], n[1], n[2], n[3], n[4], 0, 0};
  else
    p = n;
  // FULL_OPENCV is the only model with k3: without the denominator it is the shorter lens.
  if (p.size() == 12 && p[9] == 0 && p[10] == 0 && p[11] == 0) p.resize(9);
  p[2] -= colmap_half_pixel;
  p[3] -= colmap_half_pixel;
  require_sound_numbers(camera, where);
}

ColmapParameters colmap_parameters(const Camera& camera) {
  ColmapParameters out{"", camera.parameters};
  std::vector<double>& p = out.numbers;
  p[2] += colmap_half_pixel;
  p[3] += colmap_half_pixel;
  if (camera.model == "fisheye") {
    out.model = "OPENCV_FISHEYE";
  } else if (camera.model != "brown_conrady") {
    bad_input({}, "camera {}: COLMAP has no counterpart of the lens model {}", in_quotes(camera.name),
              camera.model);
  } else if (p.size() == 4) {
    out.model = "PINHOLE";
  } else if (p.size() == 8) {
    out.model = "OPENCV";
  } else {
    p.resize(12, 0.0);
    out.model = "FULL_OPENCV";
  }
  return out;
}

}  // namespace bpms
