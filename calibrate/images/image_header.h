// What the head of an image file says, read without decoding the picture: its size, so that none is decoded
// that memory cannot hold, and from EXIF which camera took it. JPEG, PNG, TIFF and BMP; of other files
// nothing is known. Sources: ITU T.81 annex B, the PNG and TIFF 6.0 specifications, CIPA DC-008 (EXIF).
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace bpms {

struct ImageHeader {
  std::int64_t width_px = 0, height_px = 0;  // 0: not known
  int orientation = 1;                       // EXIF: 1 is upright, 3 half a turn, 6 and 8 quarter turns
  std::string maker, model, serial;          // empty: not told
  double focal_mm = 0;                       // 0: not told
  // "maker model, serial 17, 50 mm", as far as told.
  std::string device() const;
};

ImageHeader read_image_header(std::string_view bytes);

}  // namespace bpms
