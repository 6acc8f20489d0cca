#include "scene/pictures/colouring.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/nearest.h"
#include "core/text.h"

namespace bpms {
namespace {

bool is_ground(const Prototype& prototype) {
  return prototype.name == ground_kind && prototype.mesh && prototype.mesh->organs.size() == 1 &&
         prototype.mesh->organs[0].kind == ground_kind;
}

using CategoryOf = std::string (*)(const Prototype&, const PicturePart&);
struct CategoryKind {
  const char* name;
  CategoryOf of;
};
const CategoryKind category_kinds[] = {
    {"organ", [](const Prototype&, const PicturePart& part) { return part.label; }},
    {"material", [](const Prototype&, const PicturePart& part) { return part.material; }},
    {"kind", [](const Prototype&, const PicturePart& part) { return part.kind; }},
    {"plant", [](const Prototype& prototype, const PicturePart&) { return prototype.name; }},
};

struct NumberKind {
  const char* name;
  const char* title;
  double (*of)(const PicturePart&);
};
const NumberKind number_kinds[] = {
    {"length", "length, m", [](const PicturePart& part) { return part.length_m; }},
    {"area", "area, m\u00b2", [](const PicturePart& part) { return part.area_m2; }},
    {"height", "mean height, m", [](const PicturePart& part) { return part.height_m; }},
    {"leaf_inclination", "leaf inclination, \u00b0",
     [](const PicturePart& part) {
       return part.kind == "leaf" || part.kind == "disc" ? part.inclination_deg : std::nan("");
     }},
};

double property_of(const PicturePart& part, const std::string& name) {
  for (const auto& [key, value] : part.properties)
    if (key == name) return parse_number(value).value_or(std::nan(""));
  return std::nan("");
}

Rgb category_colour(const std::string& kind, const std::string& label, std::size_t number) {
  if (kind == "material" || kind == "kind" || label == ground_kind) return material_colour(label, number);
  return list_colour(number);
}

void by_category(const Scene& scene, const std::vector<PictureParts>& parts, const CategoryKind& kind,
                 Colouring& out) {
  std::map<std::string, std::size_t> number_of;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    for (const PicturePart& part : parts[k].parts) {
      std::string label = kind.of(scene.prototypes[k], part);
      if (label.empty()) label = part.kind.empty() ? "(no name)" : part.kind;
      const std::size_t number = number_of.try_emplace(label, out.entries.size()).first->second;
      if (number == out.entries.size())
        out.entries.push_back({label, category_colour(kind.name, label, number)});
      out.colour_of[k].push_back(out.entries[number].colour);
      out.value_of[k].push_back(static_cast<double>(number));
    }
  }
}

template <class NumberOf>
void by_number(const Scene& scene, const std::vector<PictureParts>& parts, const NumberOf& number_of,
               Colouring& out) {
  out.is_scale = true;
  out.low = std::numeric_limits<double>::infinity();
  out.high = -out.low;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    for (const PicturePart& part : parts[k].parts) {
      const double value = is_ground(scene.prototypes[k]) ? std::nan("") : number_of(part);
      out.value_of[k].push_back(value);
      if (!std::isfinite(value)) continue;
      out.low = std::min(out.low, value), out.high = std::max(out.high, value);
    }
  }
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Rgb none = is_ground(scene.prototypes[k]) ? material_colour(ground_kind, 0) : no_value_colour;
    for (const double value : out.value_of[k]) {
      const bool has = std::isfinite(value);
      out.some_without_value |= !has && !is_ground(scene.prototypes[k]);
      const double width = out.high - out.low;
      out.colour_of[k].push_back(has ? scale_colour(width > 0 ? (value - out.low) / width : 0.5) : none);
    }
  }
}

bool has_numbers(const Colouring& colouring) {
  return colouring.low <= colouring.high;
}

// False where the name means nothing; a scale without any number is left for the caller to see.
bool fill(const Scene& scene, const std::vector<PictureParts>& parts, Colouring& out) {
  for (const CategoryKind& kind : category_kinds) {
    if (out.name != kind.name) continue;
    by_category(scene, parts, kind, out);
    return true;
  }
  for (const NumberKind& kind : number_kinds) {
    if (out.name != kind.name) continue;
    out.title = kind.title;
    by_number(scene, parts, kind.of, out);
    return true;
  }
  const std::string name = out.name;
  by_number(
      scene, parts, [&name](const PicturePart& part) { return property_of(part, name); }, out);
  return has_numbers(out);
}

Colouring empty_colouring(const std::vector<PictureParts>& parts, const std::string& name) {
  Colouring out;
  out.name = out.title = name;
  out.colour_of.resize(parts.size());
  out.value_of.resize(parts.size());
  return out;
}

}  // namespace

Colouring make_colouring(const Scene& scene, const std::vector<PictureParts>& parts,
                         const std::string& name) {
  Colouring out = empty_colouring(parts, name);
  if (!fill(scene, parts, out))
    bad_input({"--colour"}, "nothing here has the name {}{}", in_quotes(name),
              did_you_mean(name, known_colourings(scene, parts)));
  if (out.is_scale && !has_numbers(out))
    bad_input({"--colour"}, "{}: no part of this has one", in_quotes(name));
  return out;
}

std::vector<std::string> known_colourings(const Scene& scene, const std::vector<PictureParts>& parts) {
  std::vector<std::string> names, out;
  for (const CategoryKind& kind : category_kinds) names.emplace_back(kind.name);
  for (const NumberKind& kind : number_kinds) names.emplace_back(kind.name);
  for (const PictureParts& of : parts)
    for (const PicturePart& part : of.parts)
      for (const auto& property : part.properties)
        if (std::find(names.begin(), names.end(), property.first) == names.end())
          names.push_back(property.first);
  for (const std::string& name : names) {
    Colouring colouring = empty_colouring(parts, name);
    if (fill(scene, parts, colouring) && (!colouring.is_scale || has_numbers(colouring))) out.push_back(name);
  }
  return out;
}

}  // namespace bpms
