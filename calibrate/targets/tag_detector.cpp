#include "calibrate/targets/tag_detector.h"

#include <apriltag/apriltag.h>
#include <apriltag/common/zarray.h>
#include <apriltag/tag36h11.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <opencv2/core.hpp>

namespace bpms {
namespace {

// Of the detector, one of its own for every caller: it is not re-entrant. The order matters: the detector
// refers to the family.
class TagLibrary {
 public:
  TagLibrary() : family_(tag36h11_create()), detector_(apriltag_detector_create()) {
    constexpr int bits_corrected = 0;
    apriltag_detector_add_family_bits(detector_, family_, bits_corrected);
    detector_->quad_decimate = 1;
    detector_->refine_edges = true;
    detector_->nthreads = 1;
  }
  ~TagLibrary() {
    apriltag_detector_destroy(detector_);
    tag36h11_destroy(family_);
  }
  TagLibrary(const TagLibrary&) = delete;
  TagLibrary& operator=(const TagLibrary&) = delete;

  std::unique_ptr<zarray_t, void (*)(zarray_t*)> detect(const cv::Mat& grey) const {
    image_u8_t image{grey.cols, grey.rows, static_cast<int>(grey.step), grey.data};
    return {apriltag_detector_detect(detector_, &image), apriltag_detections_destroy};
  }

 private:
  apriltag_family_t* family_;
  apriltag_detector_t* detector_;
};

SeenTag seen_tag(const apriltag_detection_t& detection) {
  // The library goes round from the lower left corner, by the lower right one.
  constexpr int library_corner[] = {3, 2, 1, 0};
  constexpr double pixel_centre = 0.5;
  SeenTag out;
  out.id = detection.id;
  for (std::size_t i = 0; i < 4; ++i) {
    const double* p = detection.p[library_corner[i]];
    out.corners[i] = Eigen::Vector2d(p[0] - pixel_centre, p[1] - pixel_centre);
  }
  return out;
}

}  // namespace

SeenTags find_tags(const cv::Mat& grey, const std::set<int>& wanted) {
  constexpr float least_margin = 30;
  SeenTags out;
  std::map<int, std::vector<SeenTag>> sharp;
  const TagLibrary library;
  const auto found = library.detect(grey);
  for (int i = 0; i < zarray_size(found.get()); ++i) {
    apriltag_detection_t* detection = nullptr;
    zarray_get(found.get(), i, static_cast<void*>(&detection));
    if (!wanted.contains(detection->id) || detection->hamming != 0) continue;
    if (detection->decision_margin > least_margin)
      sharp[detection->id].push_back(seen_tag(*detection));
    else
      out.remarks.push_back(fmt::format("tag {} has too little contrast (margin {:.0f}, above {:.0f} needed)",
                                        detection->id, detection->decision_margin, least_margin));
  }
  for (const auto& [id, places] : sharp) {
    if (places.size() == 1)
      out.tags.push_back(places.front());
    else
      out.remarks.push_back(fmt::format("tag {} is in the image {} times and left out", id, places.size()));
  }
  return out;
}

std::vector<std::vector<bool>> tag_pattern(int id) {
  apriltag_family_t* family = tag36h11_create();
  image_u8_t* image = apriltag_to_image(family, id);
  constexpr int white_border = 1;
  std::vector<std::vector<bool>> out(tag_bits, std::vector<bool>(tag_bits));
  for (int row = 0; row < tag_bits; ++row) {
    for (int column = 0; column < tag_bits; ++column)
      out[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] =
          image->buf[(row + white_border) * image->stride + column + white_border] == 0;
  }
  image_u8_destroy(image);
  tag36h11_destroy(family);
  return out;
}

const std::array<Eigen::Vector3d, 4>& unit_tag_corners() {
  static const std::array<Eigen::Vector3d, 4> corners{
      Eigen::Vector3d(-0.5, -0.5, 0), {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}};
  return corners;
}

}  // namespace bpms
