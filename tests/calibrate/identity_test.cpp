#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/images/image_identity.h"
#include "tests/data.h"

namespace bpms {
namespace {

void add(std::string& out, std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i));
}

// The start of a JPEG with an EXIF segment, byte by byte (little-endian TIFF): texts of IFD0 and of the EXIF
// IFD, and ratios of the latter.
struct ExifJpeg {
  struct Entry {
    std::uint16_t tag;
    std::string text;  // or, when empty, a ratio
    std::uint32_t up = 0, down = 1;
  };
  std::vector<Entry> first, exif;

  std::string bytes() const {
    std::string tiff = "II";
    add(tiff, 42, 2);
    add(tiff, 8, 4);
    const std::size_t pointer_at = append(tiff, first, true);
    const auto at = static_cast<std::uint32_t>(tiff.size());
    for (int i = 0; i < 4; ++i)
      tiff[pointer_at + static_cast<std::size_t>(i)] = static_cast<char>(at >> (8 * i));
    append(tiff, exif, false);
    std::string out = "\xff\xd8\xff\xe1";
    const std::size_t size = tiff.size() + 8;
    out += static_cast<char>(size >> 8);
    out += static_cast<char>(size);
    return out + std::string("Exif\0\0", 6) + tiff + "\xff\xd9";
  }

 private:
  // Returns where the pointer to the EXIF IFD stands.
  static std::size_t append(std::string& tiff, const std::vector<Entry>& entries, bool with_pointer) {
    const std::size_t count = entries.size() + (with_pointer ? 1 : 0);
    std::size_t data_at = tiff.size() + 2 + 12 * count + 4, pointer = 0;
    std::string data;
    add(tiff, static_cast<std::uint32_t>(count), 2);
    for (const Entry& e : entries) {
      const bool ratio = e.text.empty();
      add(tiff, e.tag, 2);
      add(tiff, ratio ? 5 : 2, 2);
      add(tiff, ratio ? 1 : static_cast<std::uint32_t>(e.text.size() + 1), 4);
      std::string value = e.text + '\0';
      if (ratio) {
        value.clear();
        add(value, e.up, 4);
        add(value, e.down, 4);
      }
      if (value.size() <= 4) {
        value.resize(4, '\0');
        tiff += value;
      } else {
        add(tiff, static_cast<std::uint32_t>(data_at + data.size()), 4);
        data += value;
      }
    }
    if (with_pointer) {
      add(tiff, 0x8769, 2);
      add(tiff, 4, 2);
      add(tiff, 1, 4);
      pointer = tiff.size();
      add(tiff, 0, 4);
    }
    add(tiff, 0, 4);
    tiff += data;
    return pointer;
  }
};

ExifJpeg photograph() {
  return {{{0x010f, "Maker"}, {0x0110, "Model 7"}},
          {{0x829d, "", 56, 10},
           {0x9003, "2024:05:06 07:08:09"},
           {0x920a, "", 350, 10},
           {0xa431, "0042"},
           {0xa434, "35 mm f/2"}}};
}

TEST(Identity, IsReadFromExif) {
  const test::TemporaryFolder folder;
  const auto found = image_identity(folder.write("a.jpg", photograph().bytes()));
  const std::map<std::string, std::string> expected{{"make", "Maker"},
                                                    {"model", "Model 7"},
                                                    {"aperture", "5.6"},
                                                    {"focal_length_mm", "35"},
                                                    {"serial", "0042"},
                                                    {"lens", "35 mm f/2"},
                                                    {"date", "2024:05:06 07:08:09"}};
  EXPECT_EQ(found, expected);
  EXPECT_TRUE(image_identity(folder.write("b.png", "\x89PNG")).empty());
  // Cut anywhere: what is left, never more.
  const std::string whole = photograph().bytes();
  for (std::size_t size = 2; size < whole.size(); size += 7)
    for (const auto& [key, value] : image_identity(folder.write("c.jpg", whole.substr(0, size))))
      EXPECT_THAT(expected.at(key), ::testing::StartsWith(value));
}

TEST(Identity, AnotherBodyIsRefusedAnotherApertureIsNoted) {
  const test::TemporaryFolder folder;
  Camera camera;
  camera.name = "left";
  camera.identity = image_identity(folder.write("a.jpg", photograph().bytes()));
  EXPECT_TRUE(require_same_identity(camera, folder / "a.jpg", false).empty());
  ExifJpeg other = photograph();
  other.exif[0].up = 80;
  other.exif[1].text = "2025:01:01 00:00:00";
  const auto notes = require_same_identity(camera, folder.write("b.jpg", other.bytes()), false);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0], ::testing::HasSubstr("aperture is '8', camera 'left' was calibrated with '5.6'"));
  other.exif[3].text = "0043";
  folder.write("b.jpg", other.bytes());
  BPMS_EXPECT_ERROR(require_same_identity(camera, folder / "b.jpg", false), ErrorKind::bad_input,
                    "serial is '0043'");
  EXPECT_EQ(require_same_identity(camera, folder / "b.jpg", true).size(), 2u);
  // 349/10 mm is another zoom; 35000001/1000000 is rounding.
  other = photograph();
  other.exif[2].up = 349;
  folder.write("b.jpg", other.bytes());
  BPMS_EXPECT_ERROR(require_same_identity(camera, folder / "b.jpg", false), ErrorKind::bad_input,
                    "focal_length_mm");
  other.exif[2].up = 35000001;
  other.exif[2].down = 1000000;
  EXPECT_TRUE(require_same_identity(camera, folder.write("b.jpg", other.bytes()), false).empty());
}

TEST(Identity, OfACameraIsWhatItsImagesAgreeOn) {
  const test::TemporaryFolder folder;
  ExifJpeg other = photograph();
  other.exif[0].up = 80;
  std::vector<std::string> notes;
  const auto common = common_identity(
      {folder.write("a.jpg", photograph().bytes()), folder.write("b.jpg", other.bytes())}, notes);
  EXPECT_FALSE(common.contains("aperture"));
  EXPECT_EQ(common.at("serial"), "0042");
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0], ::testing::HasSubstr("aperture is '8', '5.6' in other images"));
}

}  // namespace
}  // namespace bpms
