// Plant texts of every construct, at random.
#pragma once
#include <fmt/format.h>
#include <rapidcheck.h>

#include <string>
#include <vector>

namespace bpms {

// A number with up to 12 digits, as people and programs write them.
inline rc::Gen<double> random_number(double low, double high) {
  return rc::gen::map(rc::gen::inRange<long long>(0, 1'000'000'000'001LL),
                      [=](long long n) { return low + (high - low) * static_cast<double>(n) * 1e-12; });
}

inline std::string text_of(double value) {
  return fmt::format("{:.12g}", value);
}

// "2.5", or the same as an expression.
inline std::string random_value(double low, double high) {
  const std::string value = text_of(*random_number(low, high));
  switch (*rc::gen::inRange(0, 8)) {
    case 0:
      return "(" + value + ")";
    case 1:
      return "( " + value + "*one )";
    case 2:
      return "(max(" + value + ",-1000)/(one ^ 2)-0*-half)";
    default:
      return value;
  }
}

inline std::string random_word() {
  std::string out;
  int depth = 0;
  bool terminal = false;
  std::vector<bool> outer;
  const int length = *rc::gen::inRange(1, 40);
  for (int i = 0; i < length; ++i) {
    switch (*rc::gen::inRange(0, 8)) {
      case 0:
        if (!terminal && *rc::gen::inRange(0, 3) == 0) out += "< s[+ l] >(one + 1) ";
        out += '[';
        outer.push_back(terminal);
        ++depth;
        break;
      case 1:
        if (depth == 0) break;
        out += ']';
        terminal = outer.back();
        outer.pop_back();
        --depth;
        break;
      default: {
        if (terminal) break;
        const char letter = "bslh+c"[*rc::gen::inRange(0, 6)];
        out += letter;
        if (*rc::gen::inRange(0, 4) == 0) out += fmt::format("({})", *rc::gen::inRange(0, 9));
        terminal = letter == 'l' || letter == 'h' || letter == 'c';
      }
    }
  }
  if (out.find_first_of("bslh+c") == std::string::npos) out += terminal ? "" : "s";
  return out + std::string(static_cast<std::size_t>(depth), ']');
}

inline std::string random_function() {
  const char code = "npfs"[*rc::gen::inRange(0, 4)];
  std::string out(1, code);
  const int count = *rc::gen::inRange(2, 6);
  for (int i = 0; i < count; ++i) {
    if (code == 'n' || code == 's') out += fmt::format(" {}", static_cast<double>(i) / (count - 1));
    out += " " + random_value(-200, 200);
  }
  return out;
}

inline std::string random_property() {
  const std::string value =
      *rc::gen::element<std::string>("low", "12", "-0.50", "a.b-c_d", "\"\"", "\"two words # no comment\"",
                                     "\"a_length\"", "\"{\"", "\"a \\\"quote\\\" and \\\\\"", "(3 * half)");
  return "p_" + *rc::gen::element<std::string>("age_d", "x", "water_status") + " " + value + "\n";
}

inline std::string random_block(char letter, int which) {
  std::string out = fmt::format("{}{} {{\n", letter, which == 0 ? "" : fmt::format(" {}", which));
  const auto maybe = [](const std::string& line) {
    return *rc::gen::arbitrary<bool>() ? line + "\n" : std::string();
  };
  if (letter == 'c')
    out += *rc::gen::element<std::string>("organ o\n", "organ o size 2\n", "n 2 organ o size (half)\n");
  const bool shaped = letter == 's' || letter == 'l' || letter == 'h';
  if (shaped || letter == 'b') out += maybe("material m" + std::to_string(*rc::gen::inRange(0, 5)));
  if (shaped) out += maybe("a_length " + random_value(0.01, 300));
  if (letter == 'l') out += maybe("a_width " + random_value(0.01, 30));
  if (letter == 'l') out += maybe("a_senescent " + random_value(0, 1)) + maybe("senescent_material straw");
  if (letter == 's') out += maybe("a_joint " + random_value(0, 3));
  if (letter == 'b' || letter == 's' || letter == 'h') out += maybe("a_radius " + random_value(0.01, 3));
  for (const char* angle : {"inclination", "azimuth", "twist"}) {
    if (shaped && *rc::gen::arbitrary<bool>())
      out += fmt::format("f_{} {}\n", angle, random_function());
    else
      out += maybe(fmt::format("a_{} {}", angle, random_value(-360, 360)));
  }
  if (letter == 'l') out += maybe("f_curvature " + random_function());
  if (shaped) out += maybe("f_width " + random_function());
  if (letter != '+' && *rc::gen::arbitrary<bool>()) out += random_property();
  return out + "}\n";
}

inline std::string random_organs(const std::string& letters, int most_blocks) {
  std::string out = random_word() + "\n";
  for (const char letter : letters) {
    for (int which = 0; which < most_blocks; ++which) {
      if (*rc::gen::arbitrary<bool>()) out += random_block(letter, which);
    }
  }
  return out;
}

inline std::string random_plant_text() {
  std::string out = std::string("units ") + (*rc::gen::element("cm", "mm", "m")) + "\n";
  out += "let one = 1\nlet half=( one/2 )\n";
  out += "organ tip ( size ) { <[l]>(2) l { a_length (size) a_width (size / 4) } }\n";
  out += "organ o(size = 3, n=(one + 1)) { s " + random_organs("sl", 2) +
         "b { a_radius (size) } c 1 { organ tip size (n * size) } }\n";
  return out + random_organs("bslh+c", 3);
}

}  // namespace bpms
