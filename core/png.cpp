#include "core/png.h"

#include <png.h>

#include "core/error.h"

namespace bpms {

std::string encode_png(const RgbImage& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = image.alpha.empty() ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> joined;
  for (std::size_t i = 0; i < image.alpha.size(); ++i)
    joined.insert(joined.end(),
                  {image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2], image.alpha[i]});
  const std::uint8_t* pixels = joined.empty() ? image.rgb.data() : joined.data();
  png_alloc_size_t size = 0;
  if (!png_image_write_to_memory(&png, nullptr, &size, 0, pixels, 0, nullptr))
    fail(ErrorKind::internal, {}, "PNG encoder: {}", png.message);
  std::string out(size, '\0');
  if (!png_image_write_to_memory(&png, out.data(), &size, 0, pixels, 0, nullptr))
    fail(ErrorKind::internal, {}, "PNG encoder: {}", png.message);
  out.resize(size);
  return out;
}

}  // namespace bpms
