// Lengths, angles and amounts of memory at the border of the program: metres, radians and bytes inside, the
// user's unit outside.
#pragma once
#include <cstdint>
#include <numbers>
#include <string_view>

#include "core/error.h"

namespace bpms {

constexpr double pi = std::numbers::pi;
constexpr double degrees(double radians) {
  return radians * (180.0 / pi);
}
constexpr double radians(double degrees) {
  return degrees * (pi / 180.0);
}

// Metres in one unit named "m", "cm", "mm", "um", "km", "in"; an unknown name is bad_input at `where`.
double metres_per_unit(std::string_view unit, const SourceLocation& where);
// "25mm", "0.1 mm", "2.5e-2m" -> metres. A number without a unit is bad_input: lengths always say theirs.
double parse_length(std::string_view text, const SourceLocation& where);
// "4GiB", "512 MiB", "1.5e9 B" -> bytes, at least 1. Units: B, kB, MB, GB, TB (powers of 1000), KiB, MiB,
// GiB, TiB (of 1024); a number without one is bad_input.
std::uint64_t parse_bytes(std::string_view text, const SourceLocation& where);

}  // namespace bpms
