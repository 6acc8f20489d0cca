#include "plant/mtg.h"

#include <algorithm>
#include <map>

#include "core/text.h"

namespace bpms {

std::string Mtg::label(std::size_t vertex) const {
  const MtgVertex& v = vertices[vertex];
  return v.index < 0 ? classes[v.symbol].symbol : fmt::format("{}{}", classes[v.symbol].symbol, v.index);
}

std::optional<std::uint32_t> Mtg::feature(std::string_view name) const {
  for (std::size_t i = 0; i < features.size(); ++i)
    if (features[i].name == name) return static_cast<std::uint32_t>(i);
  return std::nullopt;
}

const std::string* Mtg::text(std::size_t vertex, std::uint32_t feature) const {
  for (const MtgValue& value : vertices[vertex].values)
    if (value.feature == feature) return &value.text;
  return nullptr;
}

std::optional<double> Mtg::number(std::size_t vertex, std::optional<std::uint32_t> feature) const {
  const std::string* found = feature ? text(vertex, *feature) : nullptr;
  return found != nullptr ? parse_number(*found) : std::nullopt;
}

std::uint32_t Mtg::class_number(const std::string& symbol, int at_scale) {
  for (std::size_t i = 0; i < classes.size(); ++i)
    if (classes[i].symbol == symbol) return static_cast<std::uint32_t>(i);
  classes.push_back({symbol, at_scale});
  return static_cast<std::uint32_t>(classes.size() - 1);
}

std::uint32_t Mtg::feature_number(const std::string& name, const std::string& type) {
  if (const auto found = feature(name)) return *found;
  features.push_back({name, type});
  columns.push_back(static_cast<std::uint32_t>(features.size() - 1));
  return columns.back();
}

void Mtg::set(std::size_t vertex, std::uint32_t feature, std::string value) {
  for (MtgValue& known : vertices[vertex].values) {
    if (known.feature != feature) continue;
    known.text = std::move(value);
    return;
  }
  vertices[vertex].values.push_back({feature, std::move(value)});
}

namespace {

// A vertex in words that do not depend on numbers in memory: its path from the top by labels and edges, with
// its values by name.
std::vector<std::string> mtg_in_words(const Mtg& mtg) {
  std::vector<std::uint64_t> path(mtg.vertices.size());
  std::vector<std::string> out;
  const std::hash<std::string> hash;
  for (std::size_t v = 0; v < mtg.vertices.size(); ++v) {
    const MtgVertex& vertex = mtg.vertices[v];
    const auto of = [&](std::int32_t at) { return at < 0 ? 0 : path[static_cast<std::size_t>(at)]; };
    std::string words = fmt::format("{}{}@{} {:x} {:x} {:x}", vertex.edge, mtg.label(v), mtg.scale(v),
                                    of(vertex.parent), of(vertex.complex), of(vertex.after));
    path[v] = hash(words);
    std::map<std::string, std::string> values;
    for (const MtgValue& value : vertex.values) values[mtg.features[value.feature].name] = value.text;
    for (const auto& value : values) words += fmt::format(" {}={}", value.first, value.second);
    out.push_back(std::move(words));
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

bool Mtg::same_as(const Mtg& other) const {
  return vertices.size() == other.vertices.size() && mtg_in_words(*this) == mtg_in_words(other);
}

}  // namespace bpms
