#include "calibrate/images/image_identity.h"

#include <libexif/exif-data.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "core/text.h"

namespace bpms {
namespace {

struct IdentityTag {
  const char* key;
  ExifIfd where;
  ExifTag tag;
  bool another_camera;
  bool number;
};
constexpr IdentityTag identity_tags[] = {
    {"make", EXIF_IFD_0, EXIF_TAG_MAKE, true, false},
    {"model", EXIF_IFD_0, EXIF_TAG_MODEL, true, false},
    {"serial", EXIF_IFD_EXIF, EXIF_TAG_BODY_SERIAL_NUMBER, true, false},
    {"lens", EXIF_IFD_EXIF, EXIF_TAG_LENS_MODEL, true, false},
    {"lens_serial", EXIF_IFD_EXIF, EXIF_TAG_LENS_SERIAL_NUMBER, true, false},
    {"focal_length_mm", EXIF_IFD_EXIF, EXIF_TAG_FOCAL_LENGTH, true, true},
    {"aperture", EXIF_IFD_EXIF, EXIF_TAG_FNUMBER, false, true},
    {"focus_m", EXIF_IFD_EXIF, EXIF_TAG_SUBJECT_DISTANCE, false, true},
    {"date", EXIF_IFD_EXIF, EXIF_TAG_DATE_TIME_ORIGINAL, false, false},
};

std::string printable_text(const ExifEntry& entry) {
  std::string out(reinterpret_cast<const char*>(entry.data), entry.size);
  out.resize(std::min(out.size(), out.find('\0')));
  std::erase_if(out, [](char c) { return static_cast<unsigned char>(c) < 0x20; });
  const std::size_t first = out.find_first_not_of(' ');
  return first == std::string::npos ? "" : out.substr(first, out.find_last_not_of(' ') - first + 1);
}

// One unsigned rational; 0/x and x/0 stand for "not known".
std::string rational_text(const ExifEntry& entry, ExifByteOrder order) {
  constexpr unsigned bytes = 8;
  if (entry.format != EXIF_FORMAT_RATIONAL || entry.size < bytes) return {};
  const ExifRational r = exif_get_rational(entry.data, order);
  if (r.numerator == 0 || r.denominator == 0) return {};
  return fmt::format("{:.6g}", static_cast<double>(r.numerator) / static_cast<double>(r.denominator));
}

bool same_identity(const std::string& a, const std::string& b, bool number) {
  const auto x = parse_number(a), y = parse_number(b);
  constexpr double relative = 1e-3;  // EXIF holds ratios of integers
  if (number && x && y) return std::abs(*x - *y) <= relative * std::max(std::abs(*x), std::abs(*y));
  return a == b;
}

}  // namespace

std::map<std::string, std::string> image_identity(const std::string& path) {
  std::map<std::string, std::string> out;
  const std::string bytes = read_file(path);
  constexpr std::size_t most = 1 << 20;  // EXIF lies at the start, in a segment of at most 64 KiB
  const std::unique_ptr<ExifData, void (*)(ExifData*)> data(
      exif_data_new_from_data(reinterpret_cast<const unsigned char*>(bytes.data()),
                              static_cast<unsigned>(std::min(bytes.size(), most))),
      &exif_data_unref);
  if (!bytes.starts_with("\xff\xd8") || !data) return out;
  const ExifByteOrder order = exif_data_get_byte_order(data.get());
  for (const IdentityTag& tag : identity_tags) {
    const ExifEntry* entry = exif_content_get_entry(data->ifd[tag.where], tag.tag);
    if (entry == nullptr || entry->data == nullptr) continue;
    const std::string value = tag.number ? rational_text(*entry, order) : printable_text(*entry);
    if (!value.empty()) out[tag.key] = value;
  }
  return out;
}

std::map<std::string, std::string> common_identity(const std::vector<std::string>& paths,
                                                   std::vector<std::string>& notes) {
  std::map<std::string, std::string> out;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const auto one = image_identity(paths[i]);
    if (i == 0) out = one;
    std::erase_if(out, [&](const auto& entry) {
      const auto& [key, value] = entry;
      if (key == "date") return false;
      const auto there = one.find(key);
      if (there != one.end() && there->second == value) return false;
      notes.push_back(fmt::format("{}: {} is {}, {} in other images: images of one camera differ", paths[i],
                                  key, there == one.end() ? "not there" : in_quotes(there->second),
                                  in_quotes(value)));
      return true;
    });
  }
  return out;
}

std::vector<IdentityDifference> identity_differences(const Camera& camera,
                                                     const std::map<std::string, std::string>& image) {
  std::vector<IdentityDifference> out;
  for (const IdentityTag& tag : identity_tags) {
    const std::string key = tag.key;
    const auto rig = camera.identity.find(key), now = image.find(key);
    if (key == "date" || rig == camera.identity.end() || now == image.end() || rig->second.empty()) continue;
    if (!same_identity(rig->second, now->second, tag.number))
      out.push_back({key, rig->second, now->second, tag.another_camera});
  }
  return out;
}

std::vector<std::string> require_same_identity(const Camera& camera, const std::string& image, bool ignore) {
  std::vector<std::string> notes;
  for (const IdentityDifference& d : identity_differences(camera, image_identity(image))) {
    const std::string words = fmt::format("{} is {}, camera {} was calibrated with {}", d.key,
                                          in_quotes(d.image), in_quotes(camera.name), in_quotes(d.rig));
    if (d.another_camera && !ignore)
      bad_input({image}, "{}: the rig is not this camera's (--ignore-identity goes on all the same)", words);
    notes.push_back(image + ": " + words);
  }
  return notes;
}

}  // namespace bpms
