// Sizes that no plant has: mostly a wrong unit. The limits are wide: leaves of palms and bananas reach
// metres, but who writes a leaf of more than one metre should have meant it.
#include <algorithm>
#include <iterator>

#include "core/units.h"
#include "plant/language/parse.h"

namespace bpms {
namespace {

struct LikelySize {
  OrganKind kind;
  const char* attribute;
  double OrganAttributes::*member;
  double least_m, most_m;
  const char* size;
};
constexpr LikelySize likely_sizes[] = {
    {OrganKind::leaf, "a_length", &OrganAttributes::length_m, 1e-3, 1, "long"},
    {OrganKind::leaf, "a_width", &OrganAttributes::width_m, 1e-4, 1, "wide"},
    {OrganKind::stem, "a_length", &OrganAttributes::length_m, 0, 120, "long"},
    {OrganKind::stem, "a_radius", &OrganAttributes::radius_m, 1e-5, 6, "in radius"},
    {OrganKind::head, "a_length", &OrganAttributes::length_m, 1e-3, 1, "long"},
    {OrganKind::head, "a_radius", &OrganAttributes::radius_m, 1e-4, 0.5, "in radius"},
    {OrganKind::bud, "a_radius", &OrganAttributes::radius_m, 1e-5, 0.1, "in radius"},
};

std::string readable_length(double metres) {
  if (metres >= 1) return fmt::format("{:.4g} m", metres);
  return metres >= 0.01 ? fmt::format("{:.4g} cm", metres * 100) : fmt::format("{:.4g} mm", metres * 1000);
}

// The unit with which the number would be a likely size: the one that changes it least.
std::string likely_unit(const LikelySize& likely, double size_m, const std::string& unit) {
  std::string best;
  double best_change = 0;
  const double number = size_m / metres_per_unit(unit, {});
  for (const char* other : {"mm", "cm", "m"}) {
    const double other_m = number * metres_per_unit(other, {});
    if (other == unit || other_m < likely.least_m || other_m > likely.most_m) continue;
    const double change = std::max(other_m / size_m, size_m / other_m);
    if (best.empty() || change < best_change) {
      best = fmt::format(" With 'units {}' it would be {}", other, readable_length(other_m));
      best_change = change;
    }
  }
  return best;
}

}  // namespace

std::vector<std::string> size_notes(const Block& block, const std::string& unit,
                                    const std::function<SourceLocation(std::string_view)>& where) {
  std::vector<std::string> out;
  const OrganAttributes& organ = block.attributes;
  const auto note = [&](std::string_view attribute, const std::string& message) {
    out.push_back(where(attribute).str() + ": " + message);
  };
  for (const LikelySize& likely : likely_sizes) {
    const double size_m = organ.*likely.member;
    if (likely.kind != block.kind || !(size_m > 0) || (size_m >= likely.least_m && size_m <= likely.most_m))
      continue;
    note(likely.attribute,
         fmt::format("a {} {} {}; is the unit ('units {}') right?{}", organ_name(block.kind),
                     readable_length(size_m), likely.size, unit, likely_unit(likely, size_m, unit)));
  }
  if (block.kind == OrganKind::leaf && organ.length_m > 0 && organ.width_m > organ.length_m)
    note("a_width", fmt::format("a leaf wider ({}) than long ({}): are a_width and a_length as meant?",
                                readable_length(organ.width_m), readable_length(organ.length_m)));
  const bool rod = block.kind == OrganKind::stem || block.kind == OrganKind::head;
  if (rod && organ.length_m > 0 && organ.radius_m > organ.length_m)
    note("a_radius",
         fmt::format("a {} of larger radius ({}) than length ({}): are a_radius and a_length as meant?",
                     organ_name(block.kind), readable_length(organ.radius_m),
                     readable_length(organ.length_m)));
  if (organ.joint > 0 && organ.f_width && organ.f_width->value(1) <= 0)
    note("a_joint", "the stem ends in a point, where a joint has no size");
  if (!organ.senescent_material.empty() && organ.senescent == 0)
    note("senescent_material", "a senescent material, but no a_senescent: nothing of the leaf has it");
  return out;
}

}  // namespace bpms
