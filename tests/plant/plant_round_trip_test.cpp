// Whatever plant there is, what was written reads back as the same plant, and writing it again gives the same
// bytes.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "core/units.h"
#include "plant/plant.h"
#include "tests/plant/random_plant.h"

namespace bpms {
namespace {

bool same(const std::unique_ptr<OrganFunction>& a, const std::unique_ptr<OrganFunction>& b) {
  if (!a || !b) return !a && !b;
  return a->code() == b->code() && a->numbers() == b->numbers();
}
bool same(const OrganAttributes& a, const OrganAttributes& b) {
  return a.material == b.material && a.length_m == b.length_m && a.width_m == b.width_m &&
         a.radius_m == b.radius_m && a.senescent == b.senescent && a.joint == b.joint &&
         a.senescent_material == b.senescent_material && a.properties == b.properties &&
         a.inclination == b.inclination && a.azimuth == b.azimuth && a.twist == b.twist &&
         same(a.f_inclination, b.f_inclination) && same(a.f_azimuth, b.f_azimuth) &&
         same(a.f_twist, b.f_twist) && same(a.f_curvature, b.f_curvature) && same(a.f_width, b.f_width);
}

void expect_same(const OrganWord& written, const OrganWord& again) {
  RC_ASSERT(again.word.size() == written.word.size());
  for (std::size_t i = 0; i < written.word.size(); ++i) {
    const Symbol &a = written.word[i], &b = again.word[i];
    RC_ASSERT(a.type == b.type && a.kind == b.kind && a.label == b.label && a.ordinal == b.ordinal &&
              a.block == b.block);
  }
  RC_ASSERT(again.blocks.size() == written.blocks.size());
  for (std::size_t i = 0; i < written.blocks.size(); ++i) {
    const Block &a = written.blocks[i], &b = again.blocks[i];
    RC_ASSERT(a.kind == b.kind && a.number == b.number && a.compound == b.compound);
    RC_ASSERT(same(a.attributes, b.attributes));
  }
}

RC_GTEST_PROP(PlantRoundTrip, ReadingWhatWasWrittenGivesTheSamePlant, ()) {
  const Plant plant = parse_plant("a.bpms", random_plant_text());
  const std::string text = plant_text(plant);
  const Plant again = parse_plant("a.bpms", text);
  RC_ASSERT(plant_text(again) == text);
  RC_ASSERT(again.unit == plant.unit);
  expect_same(plant, again);
  RC_ASSERT(again.compounds.size() == plant.compounds.size());
  for (std::size_t i = 0; i < plant.compounds.size(); ++i)
    expect_same(plant.compounds[i], again.compounds[i]);
}

// Sizes that were computed have more digits than the text keeps; what is written must still be a fixed point.
RC_GTEST_PROP(PlantRoundTrip, WritingTwiceGivesTheSameBytesForAnySize, ()) {
  Plant plant = parse_plant("a.bpms", "units cm l l { a_length 1 a_width 1 a_twist 1 }");
  plant.unit = *rc::gen::element("cm", "mm", "m");
  plant.blocks[0].attributes.length_m =
      static_cast<double>(*rc::gen::inRange<long long>(1, 1LL << 53)) * 0x1p-51;
  plant.blocks[0].attributes.twist =
      static_cast<double>(*rc::gen::inRange<long long>(1, 1LL << 53)) * 0x1p-50;
  const std::string text = plant_text(plant);
  const Plant again = parse_plant("a.bpms", text);
  RC_ASSERT(plant_text(again) == text);
  RC_ASSERT(std::abs(again.blocks[0].attributes.length_m / plant.blocks[0].attributes.length_m - 1) < 1e-14);
}

}  // namespace
}  // namespace bpms
