// Pictures as PNG: 8-bit RGB (with opacity, where there is any) out, numbers of one channel in.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"

namespace bpms {
struct RgbImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;         // rows from the top, 3 bytes a pixel
  std::vector<std::uint8_t> alpha = {};  // a byte a pixel; empty: opaque
};
std::string encode_png(const RgbImage& image);  // the file's bytes

// One number a pixel, as it stands in the file: grey of 1 to 16 bits, or the index into a palette.
struct GreyPng {
  int width = 0;
  int height = 0;
  int full_scale = 255;               // 2^bits - 1
  std::vector<std::uint16_t> values;  // rows from the top
};
// bad_input at `where`: a truncated or damaged file, a picture in colours, more than `most_pixels`.
GreyPng decode_grey_png(const std::string& bytes, const SourceLocation& where, std::size_t most_pixels);
}  // namespace bpms
