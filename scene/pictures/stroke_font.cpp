#include "scene/pictures/stroke_font.h"

#include <algorithm>
#include <cstdint>

namespace bpms {
namespace {

// Lines through points "xy", lines parted by a comma; the base line is y = 2, capitals reach to 8, small
// letters to 6, tails to 0.
struct Glyph {
  std::uint32_t code;
  const char* lines;
};
// clang-format off
constexpr Glyph glyphs[] = {
    {'!', "08 04,02 02"}, {'"', "08 07,18 17"}, {'#', "12 18,32 38,04 44,06 46"},
    {'$', "37 28 18 07 06 15 25 34 33 22 12 03,19 11"}, {'%', "02 48,07 07,43 43"},
    {'&', "42 06 07 18 27 26 04 03 12 22 44"}, {'\'', "08 07"}, {'(', "18 07 03 12"}, {')', "08 17 13 02"},
    {'*', "03 27,07 23,05 25"}, {'+', "05 45,23 27"}, {',', "12 01"}, {'-', "05 25"}, {'.', "02 02"},
    {'/', "02 38"}, {'0', "12 03 07 18 28 37 33 22 12"}, {'1', "07 18 12,02 22"}, {'2', "07 18 28 37 36 02 32"},
    {'3', "07 18 28 37 36 25 15,25 34 33 22 12 03"}, {'4', "22 28 04 34"}, {'5', "38 08 05 25 34 33 22 12 03"},
    {'6', "37 28 18 07 03 12 22 33 34 25 15 04"}, {'7', "08 38 12"},
    {'8', "15 06 07 18 28 37 36 25 15 04 03 12 22 33 34 25"}, {'9', "03 12 22 33 37 28 18 07 06 15 25 36"},
    {':', "02 02,05 05"}, {';', "12 01,15 15"}, {'<', "37 05 33"}, {'=', "04 34,06 36"}, {'>', "07 35 03"},
    {'?', "07 18 28 37 36 25 24,22 22"}, {'@', "34 24 15 16 27 36 34 44 46 37 28 18 07 03 12 32"},
    {'A', "02 28 42,14 34"}, {'B', "02 08 28 37 36 25 05,25 34 33 22 02"}, {'C', "37 28 18 07 03 12 22 33"},
    {'D', "02 08 28 46 44 22 02"}, {'E', "32 02 08 38,05 25"}, {'F', "02 08 38,05 25"},
    {'G', "47 38 18 07 03 12 32 43 45 25"}, {'H', "02 08,42 48,05 45"}, {'I', "02 08"}, {'J', "38 33 22 12 03"},
    {'K', "02 08,48 04,15 42"}, {'L', "08 02 32"}, {'M', "02 08 25 48 42"}, {'N', "02 08 42 48"},
    {'O', "12 03 07 18 38 47 43 32 12"}, {'P', "02 08 28 37 36 25 05"}, {'Q', "12 03 07 18 38 47 43 32 12,24 42"},
    {'R', "02 08 28 37 36 25 05,15 32"}, {'S', "37 28 18 07 06 15 25 34 33 22 12 03"}, {'T', "08 48,22 28"},
    {'U', "08 03 12 32 43 48"}, {'V', "08 22 48"}, {'W', "08 12 26 32 48"}, {'X', "02 48,08 42"},
    {'Y', "08 25 48,25 22"}, {'Z', "08 48 02 42"}, {'[', "18 08 02 12"}, {'\\', "08 32"}, {']', "08 18 12 02"},
    {'^', "06 18 26"}, {'_', "02 42"}, {'`', "08 17"}, {'a', "36 32,35 26 16 05 03 12 22 33"},
    {'b', "08 02,05 16 26 35 33 22 12 03"}, {'c', "35 26 16 05 03 12 22 33"}, {'d', "38 32,35 26 16 05 03 12 22 33"},
    {'e', "04 34 35 26 16 05 03 12 22 33"}, {'f', "12 17 28,06 26"}, {'g', "36 31 20 10 01,35 26 16 05 03 12 22 33"},
    {'h', "08 02,05 16 26 35 32"}, {'i', "02 06,08 08"}, {'j', "16 11 00,18 18"}, {'k', "08 02,36 03,14 32"},
    {'l', "08 02"}, {'m', "02 06,05 16 25 22,25 36 45 42"}, {'n', "02 06,05 16 26 35 32"},
    {'o', "12 03 05 16 26 35 33 22 12"}, {'p', "00 06,05 16 26 35 33 22 12 03"},
    {'q', "30 36,35 26 16 05 03 12 22 33"}, {'r', "02 06,05 16 26"}, {'s', "35 26 16 05 14 24 33 22 12 03"},
    {'t', "18 13 22,06 26"}, {'u', "06 03 12 22 33,36 32"}, {'v', "06 22 46"}, {'w', "06 12 25 32 46"},
    {'x', "02 36,06 32"}, {'y', "06 03 12 22 33,36 31 20 10 01"}, {'z', "06 36 02 32"}, {'{', "18 07 06 05 04 03 12"},
    {'|', "01 08"}, {'}', "08 17 13 02,15 15"}, {'~', "05 16 24 35"}, {0xb0, "07 18 27 16 07"},
    {0xb2, "08 18 17 05 15"}, {0xb5, "00 06,03 12 22 33,36 32"}, {0xb7, "05 05"},
};
// clang-format on
constexpr const char* unknown_glyph = "02 08 38 32 02";
constexpr double gap_units = 1.9, space_units = 2.2, cap_units = 6, base_units = 2;

const char* lines_of(std::uint32_t code) {
  for (const Glyph& glyph : glyphs)
    if (glyph.code == code) return glyph.lines;
  return unknown_glyph;
}

// The next character of UTF-8; a byte that begins none counts as itself.
std::uint32_t next_code(std::string_view text, std::size_t& at) {
  const auto first = static_cast<unsigned char>(text[at++]);
  std::uint32_t more = 0;
  std::uint32_t code = first;
  if (first >= 0xf0) {
    more = 3, code = first & 7u;
  } else if (first >= 0xe0) {
    more = 2, code = first & 15u;
  } else if (first >= 0xc0) {
    more = 1, code = first & 31u;
  }
  for (; more > 0 && at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0u) == 0x80u; --more)
    code = code << 6 | (static_cast<unsigned char>(text[at++]) & 63u);
  return code;
}

// Walks along a text and hands each stroke in grid units, x from the text's beginning; returns its width.
template <class Take>
double walk(std::string_view text, const Take& take) {
  double pen = 0, end = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::uint32_t code = next_code(text, at);
    if (code == ' ') {
      pen += space_units + gap_units;
      continue;
    }
    double width = 0;
    Eigen::Vector2d last(0, 0);
    bool first = true;
    for (const char* c = lines_of(code);; c += 2) {
      const Eigen::Vector2d point(c[0] - '0', c[1] - '0');
      width = std::max(width, point.x());
      if (!first) take(last + Eigen::Vector2d(pen, 0), point + Eigen::Vector2d(pen, 0));
      last = point, first = false;
      if (c[2] == '\0') break;
      if (c[2] == ',') first = true;
      ++c;
    }
    end = pen + width;
    pen = end + gap_units;
  }
  return end;
}

}  // namespace

std::vector<Stroke> text_strokes(std::string_view utf8, const Eigen::Vector2d& at, double cap_height) {
  std::vector<Stroke> out;
  const double unit = cap_height / cap_units;
  const auto place = [&](const Eigen::Vector2d& p) {
    return Eigen::Vector2d(at.x() + unit * p.x(), at.y() - unit * (p.y() - base_units));
  };
  walk(utf8, [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    out.push_back({place(from), place(to)});
  });
  return out;
}

double text_width(std::string_view utf8, double cap_height) {
  return cap_height / cap_units * walk(utf8, [](const Eigen::Vector2d&, const Eigen::Vector2d&) {});
}

}  // namespace bpms
