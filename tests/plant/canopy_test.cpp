// Planting: densities, spacings, periodic rows, the distributions of rotation and scale, determinism, errors.
#include "plant/canopy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/units.h"
#include "tests/data.h"

namespace bpms {
namespace {

using enum ErrorKind;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

class CanopyTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("a.bpms", "units cm s s { material stem a_length 10 a_radius 0.1 }");
    folder_.write("b.bpms", "units cm l l { material leaf a_length 10 a_width 1 }");
  }
  Canopy read(const std::string& planting, const std::string& domain = "size_m = [2.0, 1.43]",
              const std::string& plant = "", std::optional<std::uint64_t> seed = {}) {
    const std::string path =
        folder_.write("canopy.toml", "[domain]\n" + domain + "\n[[plants]]\nfile = \"a.bpms\"\n" + plant +
                                         "\n[planting]\n" + planting + "\n");
    return read_canopy(path, seed);
  }
  test::TemporaryFolder folder_;
};

// Distances across the rows modulo the spacing: how far plants are from a perfect row pattern.
std::map<long long, int> by_row(const Canopy& canopy, const Eigen::Vector2d& across, double spacing,
                                double offset) {
  std::map<long long, int> out;
  for (const Placement& p : canopy.placements)
    ++out[std::llround((p.position_m.head<2>().dot(across) - offset) / spacing)];
  return out;
}

TEST_F(CanopyTest, NormativeExampleHasItsDensity) {
  const Canopy canopy = read_canopy(std::string(BPMS_SOURCE_DIR) + "/examples/plants/canopy.toml");
  EXPECT_EQ(canopy.placements.size(), 798u);  // 279 x 2 x 1.43 = 797.94
  EXPECT_TRUE(canopy.periodic);
  EXPECT_THAT(canopy.notes, IsEmpty());  // 1.43 m hold ten rows of 0.143 m that run east
  for (const Placement& p : canopy.placements) {
    EXPECT_NEAR(p.position_m.z(), -0.02, 1e-12);
    EXPECT_LE(std::abs(p.position_m.x()), 1.0);
    EXPECT_LE(std::abs(p.position_m.y()), 0.715);
    EXPECT_NEAR(p.scale, 1, 0.15 + 1e-9);
  }
}

TEST_F(CanopyTest, RowsSnapToThePeriodicDomainAndSaySo) {
  const Canopy canopy = read("pattern = \"rows\"\nrow_spacing_m = 0.3\ndensity_per_m2 = 100");
  EXPECT_THAT(canopy.notes,
              Contains(HasSubstr("spacing 0.3 m became 0.285714 m (-4.762 %), azimuth turned by 0 degrees")));
  const auto rows = by_row(canopy, {1, 0}, 2.0 / 7, 1.0 / 7);  // seven rows run north
  EXPECT_EQ(rows.size(), 7u);
  for (const auto& [row, count] : rows) EXPECT_NEAR(count, 286.0 / 7, 1);
  EXPECT_EQ(canopy.placements.size(), 286u);
  // Without scatter every plant stands on its row, evenly spaced.
  std::vector<double> along;
  for (const Placement& p : canopy.placements) {
    const double phase = (p.position_m.x() - 1.0 / 7) / (2.0 / 7);
    EXPECT_NEAR(phase, std::round(phase), 1e-9);
    if (std::llround(phase) == 0) along.push_back(p.position_m.y());
  }
  std::ranges::sort(along);
  for (std::size_t i = 1; i < along.size(); ++i)
    EXPECT_NEAR(along[i] - along[i - 1], 1.43 / static_cast<double>(along.size()), 1e-9);
}

TEST_F(CanopyTest, ObliqueRowsCloseOnThemselves) {
  const Canopy canopy =
      read("pattern = \"rows\"\nrow_spacing_m = 0.2\nrow_azimuth_deg = 33\ndensity_per_m2 = 400",
           "size_m = [3, 3]");
  // The nearest periodic wave vector: (13, -8) / 3.
  const Eigen::Vector2d wave(std::round(3 * std::cos(radians(33)) / 0.2) / 3,
                             -std::round(3 * std::sin(radians(33)) / 0.2) / 3);
  EXPECT_THAT(canopy.notes, Contains(HasSubstr(fmt::format("became {:.6g} m", 1 / wave.norm()))));
  EXPECT_EQ(canopy.placements.size(), 3600u);
  for (const Placement& p : canopy.placements) {
    const double phase = p.position_m.head<2>().dot(wave) - 0.5;
    EXPECT_NEAR(phase, std::round(phase), 1e-9);
  }
}

TEST_F(CanopyTest, OpenRowsAreCutAtTheBorder) {
  const Canopy canopy =
      read("pattern = \"rows\"\nrow_spacing_m = 0.2\nrow_azimuth_deg = 90\nspacing_in_row_m = 0.05",
           "size_m = [2, 1]\nboundary = \"open\"");
  EXPECT_THAT(canopy.notes, IsEmpty());
  EXPECT_EQ(canopy.placements.size(), 5u * 40u);  // at 0, +-0.2, +-0.4
  EXPECT_EQ(by_row(canopy, {0, 1}, 0.2, 0.0).size(), 5u);
}

TEST_F(CanopyTest, SpacingsHaveTheStatedSpread) {
  const Canopy canopy = read(
      "pattern = \"rows\"\nrow_spacing_m = { mean = 0.1, sd = 0.01 }\nspacing_in_row_m = { mean = 0.5, sd = "
      "0.02 }",
      "size_m = [200, 10]");
  // 2000 rows of 20 plants; each row's mean x is its place.
  ASSERT_EQ(canopy.placements.size(), 40000u);
  std::vector<double> x(2000), steps;
  for (std::size_t i = 0; i < canopy.placements.size(); ++i) {
    x[i / 20] = canopy.placements[i].position_m.x();
    if (i % 20 == 0) continue;
    const double step = canopy.placements[i].position_m.y() - canopy.placements[i - 1].position_m.y();
    steps.push_back(step - 10 * std::round(step / 10));
  }
  const auto moments = [](const std::vector<double>& values) {
    double sum = 0, square = 0;
    for (const double v : values) sum += v, square += v * v;
    const double n = static_cast<double>(values.size());
    return std::pair(sum / n, std::sqrt(square / n - sum / n * sum / n));
  };
  std::vector<double> gaps;
  for (std::size_t i = 1; i < x.size(); ++i) gaps.push_back(std::remainder(x[i] - x[i - 1], 200));
  const auto [row_mean, row_sd] = moments(gaps);
  // Neighbouring gaps share a displacement: the variance of the sd is 1.5 times that of independent ones.
  EXPECT_NEAR(row_mean, 0.1, 1e-4);
  EXPECT_NEAR(row_sd, 0.01, 4 * 0.01 * std::sqrt(1.5 / (2 * 2000)));
  const auto [step_mean, step_sd] = moments(steps);
  EXPECT_NEAR(std::abs(step_mean), 0.5, 1e-3);
  EXPECT_NEAR(step_sd, 0.02, 4 * 0.02 * std::sqrt(1.5 / (2 * 38000)));
}

TEST_F(CanopyTest, RegularGridSnapsAndFills) {
  const Canopy canopy = read("pattern = \"regular\"\ndensity_per_m2 = 100");
  EXPECT_EQ(canopy.placements.size(), 20u * 14u);
  EXPECT_THAT(canopy.notes, Contains(HasSubstr("spacing 0.1 m became 0.1 m by 0.102143 m")));
  EXPECT_EQ(read("pattern = \"regular\"\nspacing_m = 0.5", "size_m = [2, 1]\nboundary = \"open\"")
                .placements.size(),
            8u);
}

TEST_F(CanopyTest, RandomPlantsAreUniform) {
  const Canopy canopy = read("pattern = \"random\"\ndensity_per_m2 = 10000", "size_m = [4, 2]");
  ASSERT_EQ(canopy.placements.size(), 80000u);
  int count[16] = {};
  for (const Placement& p : canopy.placements) {
    const int i = static_cast<int>(std::floor((p.position_m.x() / 4 + 0.5) * 4)),
              j = static_cast<int>(std::floor((p.position_m.y() / 2 + 0.5) * 4));
    ASSERT_TRUE(i >= 0 && i < 4 && j >= 0 && j < 4);
    ++count[4 * j + i];
  }
  double chi2 = 0;
  for (const int c : count) chi2 += std::pow(c - 5000, 2) / 5000;
  EXPECT_LT(chi2, 37.7);  // 15 degrees of freedom, p = 0.001
  EXPECT_GT(chi2, 3.5);
}

TEST_F(CanopyTest, HardCoreKeepsItsDistanceAroundTheBorder) {
  const Canopy canopy = read("pattern = \"hard_core\"\ndensity_per_m2 = 200\nmin_distance_m = 0.045");
  ASSERT_EQ(canopy.placements.size(), 572u);
  double nearest = 1;
  for (std::size_t i = 0; i < canopy.placements.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Eigen::Vector3d d = canopy.placements[i].position_m - canopy.placements[j].position_m;
      nearest = std::min(nearest, std::hypot(std::remainder(d.x(), 2.0), std::remainder(d.y(), 1.43)));
    }
  }
  EXPECT_GE(nearest, 0.045);
  EXPECT_LT(nearest, 0.047);
  BPMS_EXPECT_ERROR(read("pattern = \"hard_core\"\ndensity_per_m2 = 200\nmin_distance_m = 0.07"), bad_input,
                    "plants this far apart do not fit");
}

TEST_F(CanopyTest, ListsStandWhereTheyAre) {
  const Canopy canopy = read(
      "pattern = \"list\"\npositions = [[0.1, 0.2], [0.3, 0.4, 0.5], [-0.5, 0.0, 0.0, 90]]\ndepth_m = 0.02");
  ASSERT_EQ(canopy.placements.size(), 3u);
  EXPECT_LT((canopy.placements[0].position_m - Eigen::Vector3d(0.1, 0.2, -0.02)).norm(), 1e-12);
  EXPECT_LT((canopy.placements[1].position_m - Eigen::Vector3d(0.3, 0.4, 0.48)).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(canopy.placements[2].rotation, pi / 2);
  folder_.write("p.txt", "# x y\n0 0\n5 5\n");
  EXPECT_THAT(read("pattern = \"list\"\npositions = \"p.txt\"").notes,
              Contains(HasSubstr("1 of 2 listed plants stand outside the domain")));
}

TEST_F(CanopyTest, RotationsFollowTheirDistribution) {
  const std::string field = "pattern = \"random\"\ndensity_per_m2 = 100", domain = "size_m = [20, 10]";
  const auto resultant = [](const Canopy& canopy) {
    Eigen::Vector2d sum(0, 0);
    for (const Placement& p : canopy.placements)
      sum += Eigen::Vector2d(std::cos(p.rotation), std::sin(p.rotation));
    return Eigen::Vector2d(sum / static_cast<double>(canopy.placements.size()));
  };
  const double sigma = 1 / std::sqrt(2 * 20000.0);
  EXPECT_LT(resultant(read(field, domain)).norm(), 4.5 * sigma);
  // The mean resultant of von Mises is I1(kappa) / I0(kappa) = 0.697775 at kappa 2, towards its mean.
  const Eigen::Vector2d r =
      resultant(read(field, domain, "rotation = { type = \"von_mises\", mean_deg = 60, kappa = 2 }"));
  const Eigen::Vector2d towards(std::cos(radians(60)), std::sin(radians(60)));
  EXPECT_NEAR(r.dot(towards), 0.6977747, 4.5 * sigma);
  EXPECT_NEAR(r.x() * towards.y() - r.y() * towards.x(), 0, 4.5 * sigma);
  for (const Placement& p :
       read(field, "size_m = [1, 1]", "rotation = { type = \"fixed\", deg = 30 }").placements)
    EXPECT_DOUBLE_EQ(p.rotation, radians(30));
}

TEST_F(CanopyTest, PlantsOccurByTheirProbability) {
  const Canopy canopy = read("pattern = \"random\"\ndensity_per_m2 = 100", "size_m = [20, 10]",
                             "probability = 3\nscale = { mean = 2, sd = 0.1 }\n[[plants]]\nfile = "
                             "\"b.bpms\"\nprobability = 1\n[[plants]]\nfile = \"b.bpms\"\nprobability = 0");
  double share = 0, scale = 0, square = 0;
  for (const Placement& p : canopy.placements) {
    ASSERT_NE(p.plant, 2u);
    if (p.plant != 0) continue;
    share += 1;
    scale += p.scale;
    square += p.scale * p.scale;
  }
  scale /= share;
  EXPECT_NEAR(std::sqrt(square / share - scale * scale), 0.0986, 0.003);  // sd 0.1, cut at 3 sd
  EXPECT_NEAR(scale, 2, 4.5 * 0.1 / std::sqrt(share));
  EXPECT_NEAR(share / 20000, 0.75, 4.5 * std::sqrt(0.75 * 0.25 / 20000));
  EXPECT_NEAR(canopy.plants[0].probability, 0.75, 1e-12);
  ASSERT_EQ(canopy.plants[1].plant->word.size(), 1u);
  EXPECT_EQ(canopy.inputs.size(), 3u);  // its own, a.bpms and b.bpms, each named once
}

TEST_F(CanopyTest, FoldersShareTheirProbability) {
  const std::string path = folder_.write("f.toml",
                                         "[domain]\nsize_m = [1, 1]\n[[plants]]\nfolder = "
                                         "\".\"\n[planting]\npattern = \"random\"\ndensity_per_m2 = 9\n");
  const Canopy canopy = read_canopy(path);
  ASSERT_EQ(canopy.plants.size(), 2u);
  EXPECT_DOUBLE_EQ(canopy.plants[0].probability, 0.5);
  EXPECT_TRUE(canopy.plants[0].file.ends_with("a.bpms"));
}

TEST_F(CanopyTest, TheSeedDecides) {
  const std::string rows =
      "pattern = \"rows\"\nrow_spacing_m = { mean = 0.1, sd = 0.01 }\ndensity_per_m2 = 300\ndepth_m = { mean "
      "= 0.02, sd = 0.005 }";
  const auto digest = [](const Canopy& canopy) {
    std::vector<double> out;
    for (const Placement& p : canopy.placements)
      out.insert(out.end(), {p.position_m.x(), p.position_m.y(), p.position_m.z(), p.rotation, p.scale});
    return out;
  };
  const std::string domain = "size_m = [2, 1]\nseed = 4";
  EXPECT_EQ(digest(read(rows, domain)), digest(read(rows, domain)));
  EXPECT_NE(digest(read(rows, domain)), digest(read(rows, domain, "", 5)));
  EXPECT_EQ(digest(read(rows, "size_m = [2, 1]\nseed = 5")), digest(read(rows, domain, "", 5)));
}

TEST_F(CanopyTest, ErrorsNameTheKey) {
  struct Case {
    std::string planting;
    const char* message;
    const char* domain = "size_m = [1, 1]";
    const char* plant = "";
  };
  const std::string random = "pattern = \"random\"\ndensity_per_m2 = ",
                    rows = "pattern = \"rows\"\nrow_spacing_m = ";
  const Case cases[] = {
      {"pattern = \"row\"", "canopy.toml:7:11: planting.pattern: unknown 'row'; did you mean 'rows'?"},
      {random + "9\ndepht_m = 1", "canopy.toml:9:1: unknown key 'depht_m'; did you mean 'depth_m'?"},
      {random + "9\nrow_spacing_m = 1", "unknown key 'row_spacing_m'"},
      {random + "0.01", "expected at least one"},
      {random + "1e12", "more than 10000000"},
      {random + "-1", "expected a number above 0"},
      {rows + "1e-9\ndensity_per_m2 = 10", "planting.row_spacing_m"},
      {rows + "0.1", "expected one of density_per_m2, plants_per_m and spacing_in_row_m"},
      {rows + "{ mean = 0.1, sd = -1 }\ndensity_per_m2 = 1", "expected a standard deviation"},
      {random + "9", "expected two lengths above 0", "size_m = [0, 1]"},
      {random + "9\n[terrain]\nmaterial = \"soil\"\ndem = \"x.tif\"", "canopy.toml:11:1: unknown key 'dem'"},
      {random + "9", "reach zero within 3 sd", "size_m = [1, 1]", "scale = { mean = 1, sd = 0.4 }"},
      {random + "9", "expected one of file and folder", "size_m = [1, 1]", "folder = \"x\""},
      {random + "9", "did you mean 'uniform'?", "size_m = [1, 1]", "rotation = { type = \"unifrom\" }"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.message);
    BPMS_EXPECT_ERROR(read(c.planting, c.domain, c.plant), bad_input, c.message);
  }
}

}  // namespace
}  // namespace bpms
