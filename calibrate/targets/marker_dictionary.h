// ArUco dictionaries by the names that OpenCV gives them: DICT_4X4_50 to DICT_7X7_1000, DICT_ARUCO_ORIGINAL
// and the AprilTag families.
#pragma once
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace cv {
class Mat;
}

namespace bpms {

struct SeenMarker {
  int id = 0;
  std::array<Eigen::Vector2d, 4> corners;  // clockwise from the upper left one as the marker is read
};

std::vector<std::string> marker_dictionaries();
int marker_count(const std::string& dictionary);
int marker_bits(const std::string& dictionary);  // across, with the black border of one bit
// Rows of what is black.
std::vector<std::vector<bool>> marker_pattern(const std::string& dictionary, int id);
std::vector<SeenMarker> find_markers(const cv::Mat& grey, const std::string& dictionary);

}  // namespace bpms
