#include "scene/pictures/colours.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <string_view>

namespace bpms {
namespace {

constexpr std::array<Rgb, 12> hues{{{47, 125, 79},
                                    {209, 129, 42},
                                    {59, 111, 182},
                                    {156, 79, 150},
                                    {168, 150, 42},
                                    {42, 157, 154},
                                    {122, 82, 48},
                                    {127, 174, 66},
                                    {217, 139, 180},
                                    {92, 75, 155},
                                    {107, 119, 133},
                                    {85, 166, 217}}};

constexpr std::array<Rgb, 9> scale{{{68, 1, 84},
                                    {71, 45, 123},
                                    {59, 82, 139},
                                    {44, 114, 142},
                                    {33, 145, 140},
                                    {40, 174, 128},
                                    {94, 201, 98},
                                    {173, 220, 48},
                                    {253, 231, 37}}};

Rgb mixed(const Rgb& a, const Rgb& b, double place) {
  Rgb out{};
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = static_cast<std::uint8_t>(std::lround(a[k] + place * (b[k] - a[k])));
  return out;
}

struct NamedColour {
  std::initializer_list<std::string_view> words;
  Rgb colour;
};
const NamedColour named_colours[] = {
    {{"soil", "ground", "sol"}, {138, 106, 74}},
    {{"dead", "senescent", "litter"}, {184, 150, 88}},
    {{"leaf", "blade", "lamina"}, {63, 143, 79}},
    {{"stem", "culm", "stalk", "tige"}, {167, 182, 76}},
    {{"bark", "wood", "branch", "trunk"}, {117, 87, 60}},
    {{"head", "ear", "flower", "fruit", "spike"}, {217, 168, 51}},
    {{"pot", "rim"}, {181, 105, 74}},
};

}  // namespace

Rgb list_colour(std::size_t number) {
  const Rgb& hue = hues[number % hues.size()];
  constexpr double paler = 0.45;
  return number / hues.size() % 2 == 1 ? mixed(hue, {255, 255, 255}, paler) : hue;
}

Rgb material_colour(const std::string& name, std::size_t number) {
  std::string lower = name;
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const NamedColour& named : named_colours)
    for (const std::string_view word : named.words)
      if (lower.find(word) != std::string::npos) return named.colour;
  return list_colour(number + 2);
}

Rgb scale_colour(double place) {
  const double at = std::clamp(place, 0.0, 1.0) * static_cast<double>(scale.size() - 1);
  const std::size_t below = std::min(scale.size() - 2, static_cast<std::size_t>(at));
  return mixed(scale[below], scale[below + 1], at - static_cast<double>(below));
}

std::string hex_colour(const Rgb& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
}

double linear_of_srgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}
double srgb_of_linear(double value) {
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
}

}  // namespace bpms
