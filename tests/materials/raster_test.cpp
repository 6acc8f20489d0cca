// Rasters: what the formats hold, where (U,V) looks, and files that are broken.
#include <png.h>

#include "core/error.h"
#include "simulate/materials/raster_file.h"
#include "tests/data.h"

#include <gmock/gmock.h>

namespace bpms::test {
namespace {

using ::testing::ElementsAre;

// Grey PNG of these rows, 8 or 16 bits.
std::string grey_png(int width, int height, int bits, const std::vector<unsigned>& values,
                     int colour = PNG_COLOR_TYPE_GRAY) {
  std::string out;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &out,
      [](png_structp p, png_bytep bytes, std::size_t n) {
        static_cast<std::string*>(png_get_io_ptr(p))->append(reinterpret_cast<const char*>(bytes), n);
      },
      nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), bits, colour,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  std::vector<png_color> palette(256, png_color{9, 9, 9});
  if (colour == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette.data(), 4);
  png_write_info(png, info);
  const auto across = static_cast<std::size_t>(width);
  for (std::size_t row = 0; row < static_cast<std::size_t>(height); ++row) {
    std::vector<png_byte> bytes;
    for (std::size_t i = 0; i < across; ++i) {
      const unsigned value = values[row * across + i];
      if (bits == 16) bytes.push_back(static_cast<png_byte>(value >> 8));
      bytes.push_back(static_cast<png_byte>(value & 255));
    }
    png_write_row(png, bytes.data());
  }
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return out;
}

std::vector<float> integers(const std::string& bytes) {
  return parse_integers("map", bytes).values();
}

TEST(Raster, ReadsEveryFormat) {
  const auto expected = ElementsAre(0, 1, 2, 3, 40, 255);
  const Raster text = parse_integers("map", "P2 # comment\n3 2\n255\n0 1 2\n3 40 255\n");
  EXPECT_EQ(text.columns(), 3u);
  EXPECT_EQ(text.rows(), 2u);
  EXPECT_THAT(text.values(), expected);
  EXPECT_THAT(integers(std::string("P5\n3 2\n255\n\0\1\2\3\50\377", 17)), expected);
  EXPECT_THAT(integers(std::string("P5 3 1 300 \0\0\1\0\1\54", 17)), ElementsAre(0, 256, 300));
  EXPECT_THAT(integers("0,1,2\n3;40;255\n"), expected);
  EXPECT_THAT(integers(grey_png(3, 2, 8, {0, 1, 2, 3, 40, 255})), expected);
  EXPECT_THAT(integers(grey_png(2, 1, 16, {7, 65535})), ElementsAre(7, 65535));
  EXPECT_THAT(integers(grey_png(2, 1, 8, {3, 1}, PNG_COLOR_TYPE_PALETTE)), ElementsAre(3, 1));
}

TEST(Raster, HeightsArePartsOfTheFullScale) {
  EXPECT_THAT(parse_heights("bump", "P2 2 1 100 0 50").values(), ElementsAre(0, 0.5f));
  EXPECT_THAT(parse_heights("bump", grey_png(2, 1, 16, {0, 65535})).values(), ElementsAre(0, 1));
  EXPECT_THAT(parse_heights("bump", "-0.25 1.5").values(), ElementsAre(-0.25f, 1.5f));
}

TEST(Raster, HasUAlongColumnsAndVUpwards) {
  const Raster raster = parse_integers("map", "1 2 3\n4 5 6\n");
  EXPECT_EQ(raster.nearest({0.1f, 0.1f}), 4);  // the lower left
  EXPECT_EQ(raster.nearest({0.9f, 0.1f}), 6);
  EXPECT_EQ(raster.nearest({0.1f, 0.9f}), 1);
  EXPECT_EQ(raster.nearest({1.1f, -0.1f}), 1);  // wraps
  EXPECT_EQ(raster.nearest({0.5f, 1.0f}), 5);
}

TEST(Raster, IsBilinearBetweenPixelCentresWithItsSlopes) {
  const Raster raster = parse_heights("bump", "0 0 0 0\n0 2 6 0\n0 1 3 0\n0 0 0 0\n");
  // Pixel centres in the middle: U = 3/8, 5/8; V = 3/8 (1, 3) and 5/8 (2, 6).
  const Raster::Sloped at = raster.bilinear({0.45f, 0.5f});
  const float u = (0.45f - 0.375f) * 4, v = 0.5f;
  EXPECT_NEAR(at.value, (1 - v) * (1 + 2 * u) + v * (2 + 4 * u), 1e-5f);
  EXPECT_NEAR(at.per_u, ((1 - v) * 2 + v * 4) * 4, 1e-4f);
  EXPECT_NEAR(at.per_v, ((2 + 4 * u) - (1 + 2 * u)) * 4, 1e-4f);
  EXPECT_NEAR(raster.bilinear({0.375f, 0.625f}).value, 2, 1e-5f);
  // Across the border: from the last column to the first.
  const Raster saw = parse_heights("bump", "0 4\n");
  EXPECT_NEAR(saw.bilinear({0.0f, 0.0f}).value, 2, 1e-5f);
  EXPECT_NEAR(saw.bilinear({0.0f, 0.0f}).per_u, -8, 1e-4f);
  EXPECT_NEAR(saw.bilinear({0.5f, 0.3f}).per_u, 8, 1e-4f);
}

TEST(Raster, BrokenFilesGetOneLine) {
  const std::string png = grey_png(3, 2, 8, {0, 1, 2, 3, 40, 255});
  struct Case {
    std::string bytes;
    const char* message;
  };
  const Case cases[] = {
      {"", "no rows of numbers"},
      {"P2\n3 2\n255\n0 1 2\n3    4\n", "map:6:1: ends where a pixel is expected"},
      {"P2\n3 2\n", "ends where a largest value is expected"},
      {"P2\n3 2\n255\n0 1 2\n3 4 256\n", "map:5:8: expected a pixel from 0 to 255, found 256"},
      {"P2\n2 1\n255\n0 1 2\n", "more than 2 x 1 pixels"},
      {"P2\n0 1\n255\n", "map:2:2: expected a width from 1"},
      {"P2\nwide 1\n255\n", "map:2:1: expected a width"},
      {"P5\n3 2\n255\n\1\1\1\1", "ends after 4 bytes of pixels: expected 6 for 3 x 2"},
      {"P5\n1 1\n255\n\1\1\1\1", "3 bytes follow the last of 1 x 1 pixels"},
      {"P5\n2 1\n10\n\1\13", "pixel 2 of row 1 is 11: expected at most 10"},
      {"P5\n100000 100000\n255\n\1", "a picture of 100000 x 100000 pixels"},
      {"P6\n1 1\n255\n\1\1\1", "map"},
      {"1 2\n3\n", "map:2: a row of 1 numbers after rows of 2"},
      {"1 2\n3 x\n", "map:2:3: expected an integer from 0 to 65535"},
      {"1 2\n3 -4\n", "map:2:3"},
      {"1 2\n3 4.5\n", "map:2:3"},
      {std::string("GIF89a\1\0", 8), "expected PGM (P2, P5), PNG or rows of numbers"},
      {png.substr(0, 20), "PNG: "},
      {png.substr(0, png.size() - 20), "PNG: "},
      {png.substr(0, 40) + "xx" + png.substr(42), "PNG: "},
      {std::string("\x89PNG\r\n\x1a\n", 8), "PNG: "},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.bytes.substr(0, 30));
    BPMS_EXPECT_ERROR(integers(c.bytes), ErrorKind::bad_input, c.message);
  }
  const TemporaryFolder folder;
  BPMS_EXPECT_ERROR(read_integers(folder / "absent.pgm"), ErrorKind::missing_resource, "absent.pgm");
}

}  // namespace
}  // namespace bpms::test
