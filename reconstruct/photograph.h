// The little that reconstruction asks of image files.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace bpms {

struct GreyImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> values;  // rows from the top; 8-bit files keep their numbers
  std::uint16_t at(int u, int v) const {
    return values[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(u)];
  }
};
GreyImage read_grey_image(const std::string& path);

struct ImageSize {
  int width = 0;
  int height = 0;
};
ImageSize image_size(const std::string& path);

}  // namespace bpms
