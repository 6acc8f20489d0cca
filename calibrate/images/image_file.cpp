#include "calibrate/images/image_file.h"

#include <algorithm>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "calibrate/images/jpeg_grey.h"
#include "core/error.h"
#include "core/provenance.h"
#include "core/text.h"

namespace bpms {
namespace {

constexpr std::int64_t most_pixels = 250'000'000;       // beyond any camera
constexpr std::uintmax_t largest_file = 2'000'000'000;  // bytes

// The PNG decoder would say so on stderr by itself, without the file's name.
bool is_png_cut_short(std::string_view bytes) {
  constexpr std::string_view end = "IEND\xae\x42\x60\x82";
  return bytes.starts_with("\x89PNG") && bytes.find(end) == std::string_view::npos;
}

// Linear, between the 0.1 % darkest and the 0.1 % lightest: 12 bits in a 16-bit file would be black
// otherwise.
cv::Mat eight_bits(const cv::Mat& deep) {
  cv::Mat values;
  deep.convertTo(values, CV_32F);
  std::vector<float> sorted(values.begin<float>(), values.end<float>());
  sorted.erase(
      std::remove_if(sorted.begin(), sorted.end(), [](float x) { return !(x > -1e30F && x < 1e30F); }),
      sorted.end());
  if (sorted.empty()) return {};
  constexpr double tail = 0.001;
  const auto rank = [&](double share) {
    const auto at =
        sorted.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), at, sorted.end());
    return static_cast<double>(*at);
  };
  const double low = rank(tail), high = rank(1 - tail);
  cv::Mat out;
  const double scale = high > low ? 255 / (high - low) : 1;
  values.convertTo(out, CV_8U, scale, -low * scale);
  return out;
}

void decode_image(const std::string& bytes, ImageFile& out) {
  if (bytes.starts_with("\xff\xd8")) {
    out.trouble = decode_jpeg_grey(bytes, out.grey);
    return;
  }
  cv::Mat stored;
  try {
    const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
    stored = cv::imdecode(buffer, cv::IMREAD_GRAYSCALE | cv::IMREAD_ANYDEPTH | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {  // broken in a way the decoder did not expect: as unreadable as any other
  }
  if (stored.empty()) {
    out.trouble = "cannot be read as an image";
    return;
  }
  out.grey = stored.depth() == CV_8U ? stored : eight_bits(stored);
  if (stored.depth() != CV_8U)
    out.remarks.push_back(fmt::format("{} bits scaled to 8", 8 * stored.elemSize1()));
  if (out.grey.empty()) out.trouble = "has no finite grey value";
}

}  // namespace

ImageFile read_image_file(const std::string& path) {
  ImageFile out;
  std::error_code code;
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  if (code) {
    out.trouble = std::filesystem::exists(path) ? "is no file" : "no such file";
    return out;
  }
  if (size > largest_file) {
    out.trouble = fmt::format("has {} bytes, more than {} are not read", size, largest_file);
    return out;
  }
  std::string bytes;
  try {
    bytes = read_file(path);
  } catch (const Error& error) {
    out.trouble = error.message();
    return out;
  }
  out.sha256 = sha256(bytes);
  out.header = read_image_header(bytes);
  if (out.header.width_px > most_pixels || out.header.height_px > most_pixels ||
      out.header.width_px * out.header.height_px > most_pixels)
    out.trouble = fmt::format("says it has {}x{} pixels, more than {} million are not read",
                              out.header.width_px, out.header.height_px, most_pixels / 1'000'000);
  else if (bytes.empty())
    out.trouble = "is empty";
  else if (is_png_cut_short(bytes))
    out.trouble = "is cut short";
  else
    decode_image(bytes, out);
  if (out.header.orientation != 1)
    out.remarks.push_back(fmt::format("EXIF asks to turn it (orientation {}); its pixels are taken as stored",
                                      out.header.orientation));
  return out;
}

}  // namespace bpms
