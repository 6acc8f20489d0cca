// Rows: bands, drills at random, linear densities, hills; what the domain's size becomes where rows keep
// theirs.
#include <cmath>
#include <map>

#include "core/units.h"
#include "tests/chi_square.h"
#include "tests/plant/canopy_files.h"

namespace bpms {
namespace {

using enum ErrorKind;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

class RowsTest : public test::CanopyFiles {};

// Counts of values in equal classes from low to high; nothing may lie beside.
std::vector<double> histogram(const std::vector<double>& values, double low, double high, int classes) {
  std::vector<double> out(static_cast<std::size_t>(classes), 0);
  for (const double v : values) {
    EXPECT_TRUE(v >= low && v <= high) << v;
    out[static_cast<std::size_t>(std::clamp((v - low) / (high - low) * classes, 0.0, classes - 1.0))] += 1;
  }
  return out;
}
double uniform_z(const std::vector<double>& counts) {
  double sum = 0;
  for (const double c : counts) sum += c;
  return test::chi_square(counts,
                          std::vector<double>(counts.size(), sum / static_cast<double>(counts.size())))
      .z();
}

TEST_F(RowsTest, PlantsScatterEvenlyOverTheBand) {
  const Canopy canopy =
      read("size_m = [10, 50]",
           "pattern = \"rows\"\nrow_spacing_m = 0.5\nrow_width_m = 0.12\nspacing_in_row_m = 0.05");
  ASSERT_EQ(canopy.placements.size(), 20000u);
  std::vector<double> aside, along;
  for (const Placement& p : canopy.placements) {
    aside.push_back(std::remainder(p.position_m.x() - 0.25, 0.5));
    along.push_back(p.position_m.y());
  }
  EXPECT_LT(std::abs(uniform_z(histogram(aside, -0.06, 0.06, 24))), 4);
}

TEST_F(RowsTest, BandsOfDifferentWidthHaveTheirMean) {
  const Canopy canopy =
      read("size_m = [500, 5]",
           "pattern = \"rows\"\nrow_spacing_m = 0.5\nrow_width_m = { mean = 0.12, sd = 0.02 }\n"
           "spacing_in_row_m = 0.05");
  ASSERT_EQ(canopy.placements.size(), 100000u);
  double square = 0;
  for (const Placement& p : canopy.placements)
    square += std::pow(std::remainder(p.position_m.x() - 0.25, 0.5), 2);
  // E[w^2] / 12; its standard error over 1000 rows is that of w^2, sd 2 w sd_w = 0.0048, and of the plants.
  EXPECT_NEAR(square / 1e5, (0.12 * 0.12 + 0.02 * 0.02) / 12, 4 * 0.0049 / 12 / std::sqrt(1000.0));
}

TEST_F(RowsTest, DrillsAtRandomAreUniformAlongTheRow) {
  const Canopy canopy =
      read("size_m = [5, 20]",
           "pattern = \"rows\"\nrow_spacing_m = 0.5\nin_row = \"random\"\ndensity_per_m2 = 200");
  ASSERT_EQ(canopy.placements.size(), 20000u);
  std::vector<double> along;
  std::map<long long, std::vector<double>> rows;
  for (const Placement& p : canopy.placements) {
    along.push_back(p.position_m.y());
    rows[std::llround((p.position_m.x() - 0.25) / 0.5)].push_back(p.position_m.y());
    EXPECT_NEAR(std::remainder(p.position_m.x() - 0.25, 0.5), 0, 1e-9);
  }
  EXPECT_LT(std::abs(uniform_z(histogram(along, -10, 10, 40))), 4);
  // Gaps between neighbours of n random points on a closed line: the mean square is 2 / (n (n + 1)) of it.
  ASSERT_EQ(rows.size(), 10u);
  double square = 0, gaps = 0;
  for (auto& [row, y] : rows) {
    std::ranges::sort(y);
    ASSERT_EQ(y.size(), 2000u);
    for (std::size_t i = 0; i < y.size(); ++i) {
      const double gap = i == 0 ? y[0] - y.back() + 20 : y[i] - y[i - 1];
      square += gap * gap, gaps += 1;
    }
  }
  // Gaps are nearly exponential with mean 0.01: sd of the square is sqrt(20) mean^2.
  EXPECT_NEAR(square / gaps, 2 * 1e-4, 4 * std::sqrt(20.0 / gaps) * 1e-4);
}

TEST_F(RowsTest, LinearDensityCountsPlantsPerMetre) {
  const Canopy exact =
      read("size_m = [5, 20]", "pattern = \"rows\"\nrow_spacing_m = 0.5\nplants_per_m = 12.5");
  EXPECT_EQ(exact.placements.size(), 2500u);
  const Canopy varied =
      read("size_m = [500, 20]",
           "pattern = \"rows\"\nrow_spacing_m = 0.5\nplants_per_m = { mean = 12.5, sd = 2 }");
  std::map<long long, double> count;
  for (const Placement& p : varied.placements) count[std::llround((p.position_m.x() - 0.25) / 0.5)] += 1;
  ASSERT_EQ(count.size(), 1000u);
  double sum = 0, square = 0;
  for (const auto& [row, n] : count) sum += n / 20, square += n / 20 * n / 20;
  EXPECT_NEAR(sum / 1000, 12.5, 4 * 2 / std::sqrt(1000.0));
  // Whole plants add at most 1/20 a metre.
  EXPECT_NEAR(std::sqrt(square / 1000 - std::pow(sum / 1000, 2)), 2, 4 * 2 / std::sqrt(2000.0) + 0.01);
}

TEST_F(RowsTest, HillsHoldTheirPlants) {
  const Canopy canopy =
      read("size_m = [5, 20]",
           "pattern = \"rows\"\nrow_spacing_m = 0.5\nspacing_in_row_m = 0.4\nplants_per_hill = 3\n"
           "hill_radius_m = 0.05");
  ASSERT_EQ(canopy.placements.size(), 10u * 50 * 3);
  for (std::size_t i = 0; i < canopy.placements.size(); i += 3) {
    const auto apart = [&](std::size_t a, std::size_t b) {
      const Eigen::Vector3d d = canopy.placements[i + a].position_m - canopy.placements[i + b].position_m;
      return std::hypot(std::remainder(d.x(), 5.0), std::remainder(d.y(), 20.0));
    };
    EXPECT_LE(std::max({apart(0, 1), apart(0, 2), apart(1, 2)}), 0.1);
    EXPECT_LE(std::abs(std::remainder(canopy.placements[i].position_m.x() - 0.25, 0.5)), 0.05);
  }
  // A density counts plants, a mean need not be whole.
  const Canopy dense =
      read("size_m = [50, 20]",
           "pattern = \"rows\"\nrow_spacing_m = 0.5\ndensity_per_m2 = 10\nplants_per_hill = { mean = 2.5, "
           "sd = 0.5 }\nhill_radius_m = 0.05");
  // 4000 hills; the number in each has a variance of 0.25 and 1/4 at most by rounding.
  EXPECT_NEAR(static_cast<double>(dense.placements.size()), 10000, 4 * std::sqrt(4000 * 0.5));
}

TEST_F(RowsTest, TheDomainSnapsToWholeRowsAndSaysByHowMuch) {
  const std::string rows = "pattern = \"rows\"\nrow_spacing_m = 0.3\nspacing_in_row_m = 0.1\n";
  const Canopy along = read("size_m = [2, 1.43]\nsnap = \"domain\"", rows);
  EXPECT_NEAR(along.size_m.x(), 2.1, 1e-12);
  EXPECT_EQ(along.size_m.y(), 1.43);
  EXPECT_THAT(along.notes,
              testing::ElementsAre(HasSubstr(
                  "the domain snapped to whole rows: 2 x 1.43 m became 2.1 x 1.43 m (+5.000 %, +0.000 %)")));
  std::map<long long, int> count;
  for (const Placement& p : along.placements) ++count[std::llround((p.position_m.x() - 0.15) / 0.3)];
  EXPECT_EQ(count.size(), 7u);
  // Oblique rows keep spacing and azimuth; both sides change.
  const Canopy oblique = read("size_m = [5, 4]\nsnap = \"domain\"", rows + "row_azimuth_deg = 30");
  const Eigen::Vector2d wave = Eigen::Vector2d(std::cos(radians(30)), -std::sin(radians(30))) / 0.3;
  EXPECT_NEAR(oblique.size_m.x(), 14 / wave.x(), 1e-12);
  EXPECT_NEAR(oblique.size_m.y(), 7 / -wave.y(), 1e-12);
  for (const Placement& p : oblique.placements) {
    const double phase = p.position_m.head<2>().dot(wave) - 0.5;
    EXPECT_NEAR(phase, std::round(phase), 1e-9);
  }
  const Canopy grid = read("size_m = [2, 1.43]\nsnap = \"domain\"", "pattern = \"regular\"\nspacing_m = 0.3");
  EXPECT_NEAR(grid.size_m.x(), 2.1, 1e-12);
  EXPECT_NEAR(grid.size_m.y(), 1.5, 1e-12);
  EXPECT_EQ(grid.placements.size(), 35u);
}

TEST_F(RowsTest, RefusesWhatContradictsItself) {
  const std::string rows = "pattern = \"rows\"\nrow_spacing_m = 0.3\n";
  const auto refused = [&](const std::string& domain, const std::string& planting, const char* message) {
    SCOPED_TRACE(message);
    BPMS_EXPECT_ERROR(read(domain, planting), bad_input, message);
  };
  refused("size_m = [2, 2]\nsnap = \"domain\"", rows + "plants_per_m = 9\nrow_azimuth_deg = 1",
          "canopy.toml:8:17: planting.row_spacing_m: rows so oblique repeat only every 17.1896 m along y");
  refused("size_m = [2, 2]\nsnap = \"domain\"", "pattern = \"random\"\ndensity_per_m2 = 4",
          "domain.snap: this pattern has no rows");
  refused("size_m = [2, 2]\nsnap = \"domain\"\nboundary = \"open\"", rows + "plants_per_m = 9",
          "nothing snaps in an open domain");
  refused("size_m = [2, 2]", rows + "plants_per_m = 9\ndensity_per_m2 = 9", "expected one of density_per_m2");
  refused("size_m = [2, 2]", rows + "plants_per_m = 9\nrow_width_m = -1", "expected a width of 0 or more");
  refused("size_m = [2, 2]", rows + "spacing_in_row_m = { mean = 0.1, sd = 0.01 }\nin_row = \"random\"",
          "have no sd of spacing");
  refused("size_m = [2, 2]", rows + "plants_per_m = 9\nhill_radius_m = 1", "there are no hills");
  refused("size_m = [2, 2]", rows + "plants_per_m = 9\nplants_per_hill = 2", "missing key 'hill_radius_m'");
  refused("size_m = [2, 2]", rows + "plants_per_m = 9\nin_row = \"drill\"", "unknown 'drill'");
  refused("size_m = [2, 2]", rows + "plants_per_m = 9\nhill_radius_m = 1\nplants_per_hill = 1e-9",
          "more than 10000000");
  refused("size_m = [2, 2]", "pattern = \"hard_core\"\ndensity_per_m2 = 100\nmin_distance_m = 0.1",
          "400 plants this far apart do not fit at random: 100 per m2 are asked for, some 69.65 is the most");
  // Just below the most: random addition would take for ever.
  refused("size_m = [8, 8]", "pattern = \"hard_core\"\ndensity_per_m2 = 69.6\nmin_distance_m = 0.1",
          " did, 67.");
}

}  // namespace
}  // namespace bpms
