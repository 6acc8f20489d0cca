#include "core/png.h"

#include <png.h>

#include "core/error.h"

namespace bpms {

std::string encode_png(const RgbImage& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  if (!png_image_write_to_memory(&png, nullptr, &size, 0, image.rgb.data(), 0, nullptr))
    fail(ErrorKind::internal, {}, "PNG encoder: {}", png.message);
  std::string out(size, '\0');
  if (!png_image_write_to_memory(&png, out.data(), &size, 0, image.rgb.data(), 0, nullptr))
    fail(ErrorKind::internal, {}, "PNG encoder: {}", png.message);
  out.resize(size);
  return out;
}

}  // namespace bpms
