#include <algorithm>
#include <array>

#include "plant/geometry/sections/section.h"

namespace bpms {

const LeafSection &arc_section(), &v_fold_section(), &raised_midrib_section();

namespace {

const std::vector<const LeafSection*>& all_sections() {
  static const std::vector<const LeafSection*> table{
      &arc_section(),
      &v_fold_section(),
      &raised_midrib_section(),
  };
  return table;
}

}  // namespace

bool is_leaf_section(std::string_view name) {
  return std::ranges::any_of(all_sections(), [&](const LeafSection* s) { return name == s->name(); });
}

const LeafSection& leaf_section(std::string_view name) {
  for (const LeafSection* section : all_sections())
    if (name == section->name()) return *section;
  return *all_sections().front();
}

std::vector<std::string> leaf_section_names() {
  std::vector<std::string> out;
  for (const LeafSection* section : all_sections()) out.emplace_back(section->name());
  return out;
}

SectionForm section_form(const OrganAttributes& leaf, double half_angle) {
  return {half_angle, leaf.midrib_width, leaf.midrib_height};
}

}  // namespace bpms
