#include "core/units.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/nearest.h"
#include "core/text.h"

namespace bpms {
namespace {
constexpr std::array<std::pair<std::string_view, double>, 6> length_units{
    {{"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"km", 1e3}, {"in", 0.0254}}};
}

double metres_per_unit(std::string_view unit, const SourceLocation& where) {
  std::vector<std::string> known;
  for (const auto& [name, metres] : length_units) {
    if (name == unit) return metres;
    known.emplace_back(name);
  }
  bad_input(where, "unknown unit of length {}; known: m, cm, mm, um, km, in", in_quotes(unit));
}

double parse_length(std::string_view text, const SourceLocation& where) {
  const std::size_t end = text.find_last_of("0123456789.");
  if (end == std::string_view::npos)
    bad_input(where, "found {}, expected a length such as 25mm", in_quotes(text));
  const auto value = parse_number(text.substr(0, end + 1));
  std::string_view unit = text.substr(end + 1);
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  if (!value) bad_input(where, "found {}, expected a length such as 25mm", in_quotes(text));
  if (unit.empty())
    bad_input(where, "the length {} has no unit; write for example {}mm", in_quotes(text), text);
  return *value * metres_per_unit(unit, where);
}

}  // namespace bpms
