// 8-bit RGB pictures as PNG.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace bpms {
struct RgbImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  // rows from the top, 3 bytes a pixel
};
std::string encode_png(const RgbImage& image);  // the file's bytes
}  // namespace bpms
