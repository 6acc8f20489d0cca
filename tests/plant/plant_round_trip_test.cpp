// Whatever plant there is, what was written reads back as the same plant, and writing it again gives the same
// bytes.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "core/units.h"
#include "plant/plant.h"

namespace bpms {
namespace {

// A number with up to 12 digits, as people and programs write them.
rc::Gen<double> number(double low, double high) {
  return rc::gen::map(rc::gen::inRange<long long>(0, 1'000'000'000'001LL),
                      [=](long long n) { return low + (high - low) * static_cast<double>(n) * 1e-12; });
}

std::string text_of(double value) {
  return fmt::format("{:.12g}", value);
}

std::string random_word() {
  std::string out;
  int depth = 0;
  bool terminal = false;
  std::vector<bool> outer;
  const int length = *rc::gen::inRange(1, 40);
  for (int i = 0; i < length; ++i) {
    switch (*rc::gen::inRange(0, 8)) {
      case 0:
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
        const char letter = "bslh+"[*rc::gen::inRange(0, 5)];
        out += letter;
        if (*rc::gen::inRange(0, 4) == 0) out += fmt::format("({})", *rc::gen::inRange(0, 9));
        terminal = letter == 'l' || letter == 'h';
      }
    }
  }
  if (out.find_first_of("bslh+") == std::string::npos) out += terminal ? "" : "s";
  return out + std::string(static_cast<std::size_t>(depth), ']');
}

std::string random_function() {
  const char code = "npfs"[*rc::gen::inRange(0, 4)];
  std::string out(1, code);
  const int count = *rc::gen::inRange(2, 6);
  for (int i = 0; i < count; ++i) {
    if (code == 'n' || code == 's') out += fmt::format(" {}", static_cast<double>(i) / (count - 1));
    out += " " + text_of(*number(-200, 200));
  }
  return out;
}

std::string random_block(char letter, int which) {
  std::string out = fmt::format("{}{} {{\n", letter, which == 0 ? "" : fmt::format(" {}", which));
  const auto maybe = [](const std::string& line) {
    return *rc::gen::arbitrary<bool>() ? line + "\n" : std::string();
  };
  if (letter != '+') out += maybe("material m" + std::to_string(*rc::gen::inRange(0, 5)));
  if (letter != '+' && letter != 'b') out += maybe("a_length " + text_of(*number(0.01, 300)));
  if (letter == 'l') out += maybe("a_width " + text_of(*number(0.01, 30)));
  if (letter == 'b' || letter == 's' || letter == 'h') out += maybe("a_radius " + text_of(*number(0.01, 3)));
  for (const char* angle : {"inclination", "azimuth", "twist"}) {
    if (letter != 'b' && letter != '+' && *rc::gen::arbitrary<bool>())
      out += fmt::format("f_{} {}\n", angle, random_function());
    else
      out += maybe(fmt::format("a_{} {}", angle, text_of(*number(-360, 360))));
  }
  if (letter == 'l') out += maybe("f_curvature " + random_function());
  if (letter != 'b' && letter != '+') out += maybe("f_width " + random_function());
  return out + "}\n";
}

std::string random_plant_text() {
  std::string out =
      std::string("units ") + (*rc::gen::element("cm", "mm", "m")) + "\n" + random_word() + "\n";
  for (const char letter : std::string("bslh+")) {
    for (int which = 0; which < 3; ++which) {
      if (*rc::gen::arbitrary<bool>()) out += random_block(letter, which);
    }
  }
  return out;
}

bool same(const std::unique_ptr<OrganFunction>& a, const std::unique_ptr<OrganFunction>& b) {
  if (!a || !b) return !a && !b;
  return a->code() == b->code() && a->numbers() == b->numbers();
}
bool same(const OrganAttributes& a, const OrganAttributes& b) {
  return a.material == b.material && a.length_m == b.length_m && a.width_m == b.width_m &&
         a.radius_m == b.radius_m && a.inclination == b.inclination && a.azimuth == b.azimuth &&
         a.twist == b.twist && same(a.f_inclination, b.f_inclination) && same(a.f_azimuth, b.f_azimuth) &&
         same(a.f_twist, b.f_twist) && same(a.f_curvature, b.f_curvature) && same(a.f_width, b.f_width);
}

RC_GTEST_PROP(PlantRoundTrip, ReadingWhatWasWrittenGivesTheSamePlant, ()) {
  const Plant plant = parse_plant("a.bpms", random_plant_text());
  const std::string text = plant_text(plant);
  const Plant again = parse_plant("a.bpms", text);
  RC_ASSERT(plant_text(again) == text);
  RC_ASSERT(again.unit == plant.unit);
  RC_ASSERT(again.word.size() == plant.word.size());
  for (std::size_t i = 0; i < plant.word.size(); ++i) {
    const Symbol &a = plant.word[i], &b = again.word[i];
    RC_ASSERT(a.type == b.type && a.kind == b.kind && a.label == b.label && a.ordinal == b.ordinal &&
              a.block == b.block);
  }
  RC_ASSERT(again.blocks.size() == plant.blocks.size());
  for (std::size_t i = 0; i < plant.blocks.size(); ++i) {
    RC_ASSERT(plant.blocks[i].kind == again.blocks[i].kind &&
              plant.blocks[i].number == again.blocks[i].number);
    RC_ASSERT(same(plant.blocks[i].attributes, again.blocks[i].attributes));
  }
}

// Sizes that were computed have more digits than the text keeps; what is written must still be a fixed point.
RC_GTEST_PROP(PlantRoundTrip, WritingTwiceGivesTheSameBytesForAnySize, ()) {
  Plant plant = parse_plant("a.bpms", "units cm l l { a_length 1 a_width 1 a_twist 1 }");
  plant.unit = *rc::gen::element("cm", "mm", "m");
  plant.blocks[0].attributes.length_m =
      static_cast<double>(*rc::gen::inRange<long long>(1, 1LL << 53)) * 0x1p-51;
  plant.blocks[0].attributes.twist =
      static_cast<double>(*rc::gen::inRange<long long>(1, 1LL << 53)) * 0x1p-50;
  const std::string text = plant_text(plant);
  const Plant again = parse_plant("a.bpms", text);
  RC_ASSERT(plant_text(again) == text);
  RC_ASSERT(std::abs(again.blocks[0].attributes.length_m / plant.blocks[0].attributes.length_m - 1) < 1e-14);
}

}  // namespace
}  // namespace bpms
