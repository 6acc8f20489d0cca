#include "simulate/materials/column_lines.h"

#include <algorithm>

namespace bpms {
namespace {

std::vector<ColumnField> fields_of(std::string_view line) {
  std::vector<ColumnField> out;
  const bool separated = line.find_first_of(",;") != std::string_view::npos;
  const std::string_view stops = separated ? ",;" : " \t\r", around = " \t\r\"";
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find_first_of(stops, at), line.size());
    std::size_t from = at, to = end;
    while (from < to && around.find(line[from]) != std::string_view::npos) ++from;
    while (to > from && around.find(line[to - 1]) != std::string_view::npos) --to;
    if (separated || to > from) out.push_back({line.substr(from, to - from), static_cast<int>(from) + 1});
    at = end + 1;
  }
  while (!out.empty() && out.back().text.empty()) out.pop_back();
  return out;
}

}  // namespace

bool ColumnLines::next() {
  while (at_ < text_.size()) {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view line = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++number_;
    fields_ = fields_of(line.substr(0, std::min(line.find('#'), line.size())));
    if (!fields_.empty()) return true;
  }
  return false;
}

}  // namespace bpms
