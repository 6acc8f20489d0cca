#include "core/units.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/nearest.h"
#include "core/text.h"

namespace bpms {
namespace {
constexpr std::array<std::pair<std::string_view, double>, 6> length_units{
    {{"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"km", 1e3}, {"in", 0.0254}}};
constexpr std::array<std::pair<std::string_view, double>, 9> memory_units{{{"B", 1.0},
                                                                           {"kB", 1e3},
                                                                           {"MB", 1e6},
                                                                           {"GB", 1e9},
                                                                           {"TB", 1e12},
                                                                           {"KiB", 0x1p10},
                                                                           {"MiB", 0x1p20},
                                                                           {"GiB", 0x1p30},
                                                                           {"TiB", 0x1p40}}};

// A number and the unit behind it, perhaps after a space; `what` and `example` stand in the message.
struct WithUnit {
  double value;
  std::string_view unit;
};
WithUnit split_unit(std::string_view text, std::string_view what, std::string_view example_unit,
                    const SourceLocation& where) {
  const std::size_t end = text.find_last_of("0123456789.");
  const auto value = end == std::string_view::npos ? std::nullopt : parse_number(text.substr(0, end + 1));
  if (!value) bad_input(where, "found {}, expected a {} such as 25{}", in_quotes(text), what, example_unit);
  std::string_view unit = text.substr(end + 1);
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  if (unit.empty())
    bad_input(where, "the {} {} has no unit; write for example {}{}", what, in_quotes(text), text,
              example_unit);
  return {*value, unit};
}
}  // namespace

double metres_per_unit(std::string_view unit, const SourceLocation& where) {
  std::vector<std::string> known;
  for (const auto& [name, metres] : length_units) {
    if (name == unit) return metres;
    known.emplace_back(name);
  }
  bad_input(where, "unknown unit of length {}; known: m, cm, mm, um, km, in", in_quotes(unit));
}

double parse_length(std::string_view text, const SourceLocation& where) {
  const WithUnit length = split_unit(text, "length", "mm", where);
  return length.value * metres_per_unit(length.unit, where);
}

std::uint64_t parse_bytes(std::string_view text, const SourceLocation& where) {
  const WithUnit memory = split_unit(text, "memory", "GiB", where);
  const auto unit = std::find_if(memory_units.begin(), memory_units.end(),
                                 [&](const auto& known) { return known.first == memory.unit; });
  if (unit == memory_units.end())
    bad_input(where, "unknown unit of memory {}; known: B, kB, MB, GB, TB, KiB, MiB, GiB, TiB",
              in_quotes(memory.unit));
  const double bytes = memory.value * unit->second;
  constexpr double most = 0x1p60;
  if (!(bytes >= 1 && bytes <= most))
    bad_input(where, "the memory {} is out of range: expected 1 B to 1048576 TiB", in_quotes(text));
  return static_cast<std::uint64_t>(bytes);
}

}  // namespace bpms
