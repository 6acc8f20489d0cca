#include "calibrate/images/image_header.h"

#include <fmt/format.h>

#include <optional>

namespace bpms {
namespace {

// Numbers in either byte order; 0 behind the end.
class ImageBytes {
 public:
  ImageBytes(std::string_view bytes, bool big) : bytes_(bytes), big_(big) {}
  std::uint32_t number(std::size_t at, std::size_t size) const {
    std::uint32_t out = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t k = at + (big_ ? i : size - 1 - i);
      out = (out << 8) | (k < bytes_.size() ? static_cast<unsigned char>(bytes_[k]) : 0U);
    }
    return out;
  }
  std::string text(std::size_t at, std::size_t size) const {
    std::string out;
    for (std::size_t i = at; i < std::min(bytes_.size(), at + size) && bytes_[i] != '\0'; ++i)
      if (static_cast<unsigned char>(bytes_[i]) >= ' ' && static_cast<unsigned char>(bytes_[i]) < 0x7f)
        out += bytes_[i];
    while (!out.empty() && out.back() == ' ') out.pop_back();
    return out;
  }
  std::size_t size() const { return bytes_.size(); }

 private:
  std::string_view bytes_;
  bool big_;
};

enum TiffTag : std::uint32_t {
  tiff_width = 0x100,
  tiff_height = 0x101,
  tiff_maker = 0x10f,
  tiff_model = 0x110,
  tiff_orientation = 0x112,
  tiff_exif = 0x8769,
  exif_focal_length = 0x920a,
  exif_serial = 0xa431
};

void read_folder(const ImageBytes& tiff, std::size_t at, bool nested, ImageHeader& out) {
  constexpr std::size_t entry_size = 12, most_text = 64;
  const std::uint32_t entries = tiff.number(at, 2);
  for (std::uint32_t i = 0; i < entries && at + 2 + entry_size * (i + 1) <= tiff.size(); ++i) {
    const std::size_t entry = at + 2 + entry_size * i;
    const std::uint32_t tag = tiff.number(entry, 2), type = tiff.number(entry + 2, 2),
                        count = tiff.number(entry + 4, 4), offset = tiff.number(entry + 8, 4);
    constexpr std::uint32_t short_type = 3;
    const std::uint32_t value = type == short_type ? tiff.number(entry + 8, 2) : offset;
    const auto text = [&] {
      constexpr std::uint32_t in_place = 4;
      return tiff.text(count <= in_place ? entry + 8 : offset, std::min<std::size_t>(count, most_text));
    };
    if (tag == tiff_width) out.width_px = value;
    if (tag == tiff_height) out.height_px = value;
    if (tag == tiff_orientation && value >= 1 && value <= 8) out.orientation = static_cast<int>(value);
    if (tag == tiff_maker) out.maker = text();
    if (tag == tiff_model) out.model = text();
    if (tag == exif_serial) out.serial = text();
    if (tag == exif_focal_length && tiff.number(offset + 4, 4) > 0)
      out.focal_mm = static_cast<double>(tiff.number(offset, 4)) / tiff.number(offset + 4, 4);
    if (tag == tiff_exif && !nested) read_folder(tiff, value, true, out);
  }
}

bool read_tiff(std::string_view bytes, ImageHeader& out) {
  const bool big = bytes.starts_with(std::string_view("MM\0*", 4));
  if (!big && !bytes.starts_with(std::string_view("II*\0", 4))) return false;
  const ImageBytes tiff(bytes, big);
  read_folder(tiff, tiff.number(4, 4), false, out);
  return true;
}

void read_jpeg(std::string_view bytes, ImageHeader& out) {
  const ImageBytes jpeg(bytes, true);
  std::size_t at = 2;
  while (at + 4 <= bytes.size() && jpeg.number(at, 1) == 0xff) {
    const std::uint32_t marker = jpeg.number(at + 1, 1), length = jpeg.number(at + 2, 2);
    constexpr std::uint32_t scan = 0xda, app1 = 0xe1, first_frame = 0xc0, last_frame = 0xcf;
    if (marker == scan || length < 2) return;
    const bool table = marker == 0xc4 || marker == 0xc8 || marker == 0xcc;  // among the frames, but none
    if (marker >= first_frame && marker <= last_frame && !table) {
      out.height_px = jpeg.number(at + 5, 2);
      out.width_px = jpeg.number(at + 7, 2);
    }
    const std::string_view segment = bytes.substr(at + 4, length - 2);
    constexpr std::string_view exif("Exif\0\0", 6);
    if (marker == app1 && segment.starts_with(exif)) {
      ImageHeader told;
      read_tiff(segment.substr(exif.size()), told);  // its size is that of the thumbnail's picture
      told.width_px = out.width_px;
      told.height_px = out.height_px;
      out = told;
    }
    at += 2 + length;
  }
}

}  // namespace

std::string ImageHeader::device() const {
  std::string out = model.starts_with(maker) ? model : maker + " " + model;
  if (!serial.empty()) out += ", serial " + serial;
  if (focal_mm > 0) out += fmt::format("{}{:.4g} mm", out.empty() ? "" : ", ", focal_mm);
  return out;
}

ImageHeader read_image_header(std::string_view bytes) {
  ImageHeader out;
  if (bytes.starts_with("\xff\xd8")) {
    read_jpeg(bytes, out);
  } else if (bytes.starts_with("\x89PNG")) {
    const ImageBytes png(bytes, true);
    out.width_px = png.number(16, 4);
    out.height_px = png.number(20, 4);
  } else if (bytes.starts_with("BM")) {
    const ImageBytes bmp(bytes, false);
    out.width_px = bmp.number(18, 4);
    const auto height = static_cast<std::int32_t>(bmp.number(22, 4));  // below 0: rows from the top
    out.height_px = std::abs(static_cast<std::int64_t>(height));
  } else {
    read_tiff(bytes, out);
  }
  return out;
}

}  // namespace bpms
