// Colours of pictures, the same as on the report page: 8 bits each of red, green and blue (sRGB).
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace bpms {

using Rgb = std::array<std::uint8_t, 3>;

Rgb list_colour(std::size_t number);                               // twelve hues, then paler ones
Rgb material_colour(const std::string& name, std::size_t number);  // one that reminds of the thing
Rgb scale_colour(double place);  // place in [0, 1]: purple, blue, green, yellow (viridis at nine places)
inline constexpr Rgb no_value_colour{176, 182, 190};
std::string hex_colour(const Rgb& colour);  // "#2f7d4f"

double linear_of_srgb(double value);  // both from 0 to 1 (IEC 61966-2-1)
double srgb_of_linear(double value);

}  // namespace bpms
