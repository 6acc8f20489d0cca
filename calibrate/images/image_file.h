// An image as the detectors take it: 8-bit grey, pixels as stored.
#pragma once
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "calibrate/images/image_header.h"

namespace bpms {

struct ImageFile {
  cv::Mat grey;
  std::string trouble;               // why there is none
  std::vector<std::string> remarks;  // what was done to it
  std::string sha256;                // of the file
  ImageHeader header;
};

// Images of more bits are scaled so that their darkest and lightest 0.1 % fall on 0 and 255. EXIF orientation
// is not followed: a lens sits before the sensor however the camera was held.
ImageFile read_image_file(const std::string& path);

}  // namespace bpms
