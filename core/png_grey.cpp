#include <png.h>

#include <csetjmp>
#include <cstring>

#include "core/png.h"

namespace bpms {
namespace {

struct PngSource {
  const std::string* bytes;
  std::size_t at;
  char message[120];  // of the error that ended it
};

void read_png_bytes(png_structp png, png_bytep out, std::size_t count) {
  auto* source = static_cast<PngSource*>(png_get_io_ptr(png));
  if (source->bytes->size() - source->at < count) png_error(png, "the file ends early");
  std::memcpy(out, source->bytes->data() + source->at, count);
  source->at += count;
}

// Keeps the message and goes back to the setjmp: no C++ exception may pass through libpng.
[[noreturn]] void end_png(png_structp png, png_const_charp message) {
  auto* source = static_cast<PngSource*>(png_get_error_ptr(png));
  std::strncpy(source->message, message, sizeof(source->message) - 1);
  longjmp(png_jmpbuf(png), 1);
}

void pass_over_warning(png_structp, png_const_charp) {}

// What is made before the setjmp and must outlive the jump.
struct PngReading {
  PngSource source{};
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::vector<png_byte> bytes;
  std::vector<png_bytep> rows;
  png_uint_32 width = 0, height = 0;
  int bits = 0, colour = 0;
  ~PngReading() { png_destroy_read_struct(&png, &info, nullptr); }
};

// The two steps that libpng may leave by a jump: nothing with a destructor lives in them.
bool read_png_header(PngReading& reading) {
  if (setjmp(png_jmpbuf(reading.png))) return false;
  png_read_info(reading.png, reading.info);
  png_get_IHDR(reading.png, reading.info, &reading.width, &reading.height, &reading.bits, &reading.colour,
               nullptr, nullptr, nullptr);
  if (reading.bits < 8) png_set_packing(reading.png);
  png_set_interlace_handling(reading.png);
  png_read_update_info(reading.png, reading.info);
  return true;
}

bool read_png_rows(PngReading& reading) {
  if (setjmp(png_jmpbuf(reading.png))) return false;
  png_read_image(reading.png, reading.rows.data());
  png_read_end(reading.png, nullptr);
  return true;
}

}  // namespace

GreyPng decode_grey_png(const std::string& bytes, const SourceLocation& where, std::size_t most_pixels) {
  PngReading reading;
  reading.source.bytes = &bytes;
  reading.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reading.source, end_png, pass_over_warning);
  if (reading.png != nullptr) reading.info = png_create_info_struct(reading.png);
  if (reading.info == nullptr) fail(ErrorKind::missing_resource, where, "no memory to read a PNG");
  png_set_read_fn(reading.png, &reading.source, read_png_bytes);
  png_set_user_limits(reading.png, 0x7fffffff, 0x7fffffff);  // `most_pixels` is the limit
  if (!read_png_header(reading)) bad_input(where, "PNG: {}", in_quotes(reading.source.message));
  if (reading.colour != PNG_COLOR_TYPE_GRAY && reading.colour != PNG_COLOR_TYPE_PALETTE)
    bad_input(where, "PNG with {} channels: expected grey or a palette",
              static_cast<int>(png_get_channels(reading.png, reading.info)));
  if (reading.width == 0 || reading.height == 0 || reading.width > most_pixels / reading.height)
    bad_input(where, "a picture of {} x {} pixels: expected at least one and at most {}", reading.width,
              reading.height, most_pixels);
  const std::size_t row_bytes = png_get_rowbytes(reading.png, reading.info);
  constexpr std::size_t most_packed = 1100;  // deflate's 1032 and some: what no file of this size can hold
  if (row_bytes * reading.height / most_packed > bytes.size())
    bad_input(where, "PNG: {} bytes cannot hold {} x {} pixels", bytes.size(), reading.width, reading.height);
  reading.bytes.resize(row_bytes * reading.height);
  for (std::size_t row = 0; row < reading.height; ++row)
    reading.rows.push_back(reading.bytes.data() + row * row_bytes);
  if (!read_png_rows(reading)) bad_input(where, "PNG: {}", in_quotes(reading.source.message));

  GreyPng out;
  out.width = static_cast<int>(reading.width);
  out.height = static_cast<int>(reading.height);
  out.full_scale = (1 << reading.bits) - 1;
  const bool wide = reading.bits == 16;  // big-endian
  out.values.reserve(std::size_t{reading.width} * reading.height);
  for (std::size_t i = 0; i < reading.bytes.size(); i += wide ? 2 : 1)
    out.values.push_back(
        static_cast<std::uint16_t>(wide ? 256 * reading.bytes[i] + reading.bytes[i + 1] : reading.bytes[i]));
  return out;
}

}  // namespace bpms
