// AprilTags (family 36h11) in an image, by libapriltag without decimation and with refined edges. It puts
// pixel centres at halves; here they are integers.
// Olson 2011, AprilTag: a robust and flexible visual fiducial system; Wang and Olson 2016, AprilTag 2.
#pragma once
#include <Eigen/Core>
#include <array>
#include <set>
#include <string>
#include <vector>

namespace cv {
class Mat;
}

namespace bpms {

struct SeenTag {
  int id = 0;
  // Corners of the black border: upper left, upper right, lower right, lower left as the tag is read.
  std::array<Eigen::Vector2d, 4> corners;
};

struct SeenTags {
  std::vector<SeenTag> tags;         // by id
  std::vector<std::string> remarks;  // tags that were left out, and why
};

// Those of `wanted` in an 8-bit grey image. Left out: bits in error, too little contrast, an id that is there
// twice.
SeenTags find_tags(const cv::Mat& grey, const std::set<int>& wanted);

constexpr int tag_codes = 587, tag_bits = 8;  // ids; bits across the black border
// Rows of what is black inside the black border's outside edge.
std::vector<std::vector<bool>> tag_pattern(int id);
// The four corners about the centre in the frame of a tag of side 1, in the order of SeenTag::corners.
const std::array<Eigen::Vector3d, 4>& unit_tag_corners();

}  // namespace bpms
