// Corners of a target as found in the images of one or more cameras. Pixel centres are integers.
// A frame is one moment: the images of all cameras in it show the target in one place.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace bpms {

struct ImageCorner {
  int point = 0;  // index into Target::points_m()
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

struct BoardView {
  std::string image;
  int camera = 0;     // index into Observations::cameras
  std::string frame;  // digits of the file name
  std::vector<ImageCorner> corners;
  int target = 0;  // index into the targets; an image that shows several has a view of each
  // As far as measured: the blur of its edges (standard deviation) and the share of its area at the top of
  // the scale.
  double blur_px = 0, overexposed = 0;
};

struct Observations {
  struct ObservedCamera {
    std::string name;
    int width_px = 0;
    int height_px = 0;
  };
  struct Skipped {
    std::string image;
    std::string reason;
  };
  std::vector<ObservedCamera> cameras;  // the first one carries the rig's frame
  std::vector<BoardView> views;
  std::vector<Skipped> skipped;
  std::vector<Skipped> remarks;  // what was left out of images that are used, and what looks wrong with them
};

// "left01.jpg" -> camera "left", frame "01": the last digits of the name are the frame, what remains without
// separators at its ends is the camera; the folder's name where nothing remains ("left/01.jpg"). No digits:
// bad_input.
struct ImageName {
  std::string camera;
  std::string frame;
};
ImageName parse_image_name(const std::string& path);

// Corners in mrcal's table, "# filename x y level": the corners of an image row by row, level "-" for one not
// found.
Observations read_corners(const std::string& path, int width_px, int height_px, int corners_per_image);

}  // namespace bpms
