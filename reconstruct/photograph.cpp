#include "reconstruct/photograph.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/error.h"
#include "core/text.h"

namespace bpms {
namespace {

cv::Mat decode(const std::string& path, int flags) {
  const std::string bytes = read_file(path);
  cv::Mat image;
  try {
    const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
    if (!bytes.empty()) image = cv::imdecode(buffer, flags);
  } catch (const cv::Exception&) {
    // OpenCV refuses images beyond its limits by an exception, others by an empty one.
  }
  if (image.empty()) bad_input({path}, "not an image that can be decoded");
  return image;
}

}  // namespace

GreyImage read_grey_image(const std::string& path) {
  cv::Mat image = decode(path, cv::IMREAD_ANYDEPTH | cv::IMREAD_GRAYSCALE);
  if (image.depth() != CV_8U && image.depth() != CV_16U) bad_input({path}, "expected 8 or 16 bits a pixel");
  cv::Mat wide;
  image.convertTo(wide, CV_16U);
  GreyImage out{wide.cols, wide.rows, {}};
  for (int row = 0; row < wide.rows; ++row)
    out.values.insert(out.values.end(), wide.ptr<std::uint16_t>(row),
                      wide.ptr<std::uint16_t>(row) + wide.cols);
  return out;
}

ImageSize image_size(const std::string& path) {
  // The pixels as they lie in the file: a camera's turn of the picture (EXIF) is not part of the lens model.
  const cv::Mat image = decode(path, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
  return {image.cols, image.rows};
}

}  // namespace bpms
