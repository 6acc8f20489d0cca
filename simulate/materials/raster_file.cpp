#include "simulate/materials/raster_file.h"

#include <cmath>
#include <optional>

#include "core/png.h"
#include "core/text.h"

namespace bpms {
namespace {

struct RasterNumbers {
  std::size_t columns = 0, rows = 0;
  std::vector<float> values;
  float full_scale = 1;
};

std::size_t pixel_count(long long columns, long long rows, const SourceLocation& where) {
  if (columns < 1 || rows < 1 ||
      static_cast<unsigned long long>(columns) > most_raster_pixels / static_cast<unsigned long long>(rows))
    bad_input(where, "a picture of {} x {} pixels: expected at least one and at most {}", columns, rows,
              most_raster_pixels);
  return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
}

// The words of a PGM's header, in which '#' starts a comment; knows its line for messages.
class PgmHeader {
 public:
  PgmHeader(const std::string& path, const std::string& bytes) : path_(path), bytes_(bytes) {}
  std::size_t at() const { return at_; }
  SourceLocation where() const { return {path_, line_, column_of(at_)}; }
  std::optional<long long> next() {
    skip();
    const std::size_t start = at_;
    while (at_ < bytes_.size() && std::isdigit(static_cast<unsigned char>(bytes_[at_]))) ++at_;
    return parse_integer(std::string_view(bytes_).substr(start, at_ - start));
  }
  bool at_end() {
    skip();
    return at_ >= bytes_.size();
  }
  long long require(const char* what, long long low, long long high) {
    const auto number = next();
    if (!number && at_ >= bytes_.size()) bad_input(where(), "ends where {} is expected", what);
    if (!number || *number < low || *number > high)
      bad_input(where(), "expected {} from {} to {}{}", what, low, high,
                number ? fmt::format(", found {}", *number) : "");
    return *number;
  }

 private:
  int column_of(std::size_t at) const { return static_cast<int>(at - line_start_) + 1; }
  void skip() {
    while (at_ < bytes_.size()) {
      if (bytes_[at_] == '#') {
        while (at_ < bytes_.size() && bytes_[at_] != '\n') ++at_;
      } else if (!std::isspace(static_cast<unsigned char>(bytes_[at_]))) {
        return;
      } else if (bytes_[at_++] == '\n') {
        ++line_;
        line_start_ = at_;
      }
    }
  }
  const std::string& path_;
  const std::string& bytes_;
  std::size_t at_ = 2;  // after P2 or P5
  std::size_t line_start_ = 0;
  int line_ = 1;
};

RasterNumbers parse_pgm(const std::string& path, const std::string& bytes) {
  PgmHeader header(path, bytes);
  RasterNumbers out;
  const long long columns = header.require("a width", 1, most_raster_pixels);
  const long long rows = header.require("a height", 1, most_raster_pixels);
  const long long most = header.require("a largest value", 1, most_raster_value);
  const std::size_t pixels = pixel_count(columns, rows, {path});
  out.columns = static_cast<std::size_t>(columns);
  out.rows = static_cast<std::size_t>(rows);
  out.full_scale = static_cast<float>(most);
  const bool binary = bytes[1] == '5';
  const std::size_t wide = !binary || most > 255 ? 2 : 1;  // of P2, a digit and a space at least
  const std::size_t first = header.at() + 1;
  const std::size_t there = bytes.size() > first ? bytes.size() - first : 0;
  if (there + (binary ? 0 : 1) < pixels * wide)
    bad_input({path}, "ends after {} bytes of pixels: expected {} for {} x {}", there,
              binary ? fmt::format("{}", pixels * wide) : fmt::format("at least {}", pixels * wide - 1),
              columns, rows);
  out.values.reserve(pixels);
  if (!binary) {
    for (std::size_t i = 0; i < pixels; ++i)
      out.values.push_back(static_cast<float>(header.require("a pixel", 0, most)));
    if (!header.at_end()) bad_input(header.where(), "more than {} x {} pixels", columns, rows);
    return out;
  }
  if (there != pixels * wide)
    bad_input({path}, "{} bytes follow the last of {} x {} pixels", there - pixels * wide, columns, rows);
  for (std::size_t i = 0; i < pixels; ++i) {
    unsigned value = static_cast<unsigned char>(bytes[first + i * wide]);
    if (wide == 2) value = 256 * value + static_cast<unsigned char>(bytes[first + i * 2 + 1]);
    if (value > static_cast<unsigned>(most))
      bad_input({path}, "pixel {} of row {} is {}: expected at most {}", i % out.columns + 1,
                i / out.columns + 1, value, most);
    out.values.push_back(static_cast<float>(value));
  }
  return out;
}

RasterNumbers parse_rows(const std::string& path, const std::string& text, bool integers) {
  RasterNumbers out;
  int line_number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string line = text.substr(at, end - at);
    at = end + 1;
    ++line_number;
    for (char& c : line)
      if (c == ',' || c == ';') c = ' ';
    TokenReader reader(path, line);
    std::size_t columns = 0;
    for (auto token = reader.next(); token; token = reader.next(), ++columns) {
      const SourceLocation where{path, line_number, token->column};
      const auto number = parse_number(token->text);
      if (!number ||
          (integers && (*number < 0 || *number > most_raster_value || *number != std::floor(*number))))
        bad_input(where, "expected {}, found {}", integers ? "an integer from 0 to 65535" : "a number",
                  in_quotes(token->text));
      out.values.push_back(static_cast<float>(*number));
      if (!std::isfinite(out.values.back())) bad_input(where, "{} is too large", in_quotes(token->text));
    }
    if (columns == 0) continue;
    if (out.columns != 0 && columns != out.columns)
      bad_input({path, line_number}, "a row of {} numbers after rows of {}", columns, out.columns);
    out.columns = columns;
    ++out.rows;
  }
  if (out.rows == 0) bad_input({path}, "no rows of numbers");
  pixel_count(static_cast<long long>(out.columns), static_cast<long long>(out.rows), {path});
  return out;
}

RasterNumbers parse_raster(const std::string& path, const std::string& bytes, bool integers) {
  if (bytes.starts_with("P2") || bytes.starts_with("P5")) return parse_pgm(path, bytes);
  if (bytes.starts_with("\x89PNG")) {
    GreyPng image = decode_grey_png(bytes, {path}, most_raster_pixels);
    return {static_cast<std::size_t>(image.width),
            static_cast<std::size_t>(image.height),
            {image.values.begin(), image.values.end()},
            static_cast<float>(image.full_scale)};
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const auto byte = static_cast<unsigned char>(bytes[i]);
    if (byte < ' ' && byte != '\t' && byte != '\n' && byte != '\r')
      bad_input({path}, "found a byte {} at {}: expected PGM (P2, P5), PNG or rows of numbers", byte, i);
  }
  return parse_rows(path, bytes, integers);
}

}  // namespace

Raster parse_integers(const std::string& path, const std::string& bytes) {
  RasterNumbers numbers = parse_raster(path, bytes, true);
  return {numbers.columns, numbers.rows, std::move(numbers.values)};
}

Raster parse_heights(const std::string& path, const std::string& bytes) {
  RasterNumbers numbers = parse_raster(path, bytes, false);
  for (float& value : numbers.values) value /= numbers.full_scale;
  return {numbers.columns, numbers.rows, std::move(numbers.values)};
}

Raster read_integers(const std::string& path) {
  return parse_integers(path, read_file(path));
}
Raster read_heights(const std::string& path) {
  return parse_heights(path, read_file(path));
}

}  // namespace bpms
