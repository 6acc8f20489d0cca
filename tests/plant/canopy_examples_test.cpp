// The canopies of examples/canopies are read, and hold what their comments say.
#include <cmath>
#include <set>

#include "core/units.h"
#include "tests/plant/canopy_files.h"

namespace bpms {
namespace {

using testing::Contains;
using testing::HasSubstr;

Canopy canopy_example(const std::string& name) {
  return read_canopy(std::string(BPMS_SOURCE_DIR) + "/examples/canopies/" + name);
}

TEST(CanopyExamples, RowsOnRidges) {
  const Canopy canopy = canopy_example("rows_on_ridges.toml");
  EXPECT_THAT(canopy.notes, Contains(HasSubstr("the domain snapped to whole rows")));
  const Eigen::Vector2d wave = Eigen::Vector2d(std::cos(radians(20)), -std::sin(radians(20))) / 0.75;
  EXPECT_NEAR(canopy.size_m.x() * wave.x(), 4, 1e-9);
  EXPECT_NEAR(canopy.size_m.y() * wave.y(), -1, 1e-9);
  ASSERT_GT(canopy.placements.size(), 40u);
  EXPECT_EQ(canopy.placements.size() % 3, 0u);
  for (const Placement& p : canopy.placements) {
    const double phase = p.position_m.head<2>().dot(wave) - 0.5;
    EXPECT_LT(std::abs(phase - std::round(phase)) * 0.75, 0.05 + 0.05);  // half a band and a hill
    EXPECT_NEAR(p.position_m.z(), 0.18, 0.03);                           // on the flat top, 2 cm deep
  }
}

TEST(CanopyExamples, Hillside) {
  const Canopy canopy = canopy_example("hillside.toml");
  ASSERT_EQ(canopy.placements.size(), 648u);
  double low = 100, high = -100;
  for (const Placement& p : canopy.placements)
    low = std::min(low, p.position_m.z()), high = std::max(high, p.position_m.z());
  EXPECT_GT(high - low, 2.5);  // 18 m of a slope of 0.18
}

TEST(CanopyExamples, Mixture) {
  const Canopy canopy = canopy_example("mixture.toml");
  EXPECT_NEAR(canopy.size_m.x(), 2 * 3.5 * 2 * std::tan(radians(6)), 1e-9);
  std::size_t grass = 0;
  for (const Placement& p : canopy.placements) grass += p.plant == 0;
  const auto plants = static_cast<double>(canopy.placements.size());
  EXPECT_NEAR(static_cast<double>(grass) / plants, 0.6, 4 * std::sqrt(0.24 / plants));
  ASSERT_TRUE(canopy.overlap);
  EXPECT_GT(canopy.overlap->before, 0.01);
  EXPECT_LE(canopy.overlap->fraction, 0.01);
}

TEST(CanopyExamples, StemMap) {
  const Canopy canopy = canopy_example("stem_map.toml");
  ASSERT_EQ(canopy.placements.size(), 11u);
  const auto file = [&](std::size_t i) { return canopy.plants[canopy.placements[i].plant].file; };
  EXPECT_TRUE(file(0).ends_with("shrub.bpms"));
  EXPECT_TRUE(file(8).ends_with("clover.bpms"));
  EXPECT_TRUE(file(10).ends_with("grass.bpms"));
  EXPECT_DOUBLE_EQ(canopy.placements[0].scale, 1.1);
}

TEST(CanopyExamples, EachOnce) {
  const Canopy canopy = canopy_example("each_once.toml");
  std::set<std::uint32_t> plants;
  for (const Placement& p : canopy.placements) plants.insert(p.plant);
  EXPECT_EQ(canopy.placements.size(), 6u);
  EXPECT_EQ(plants.size(), 6u);
}

}  // namespace
}  // namespace bpms
