// Rotation, scale and choice of clones against their distributions, class by class.
#include "plant/canopy/clone_variation.h"

#include <cmath>

#include "core/units.h"
#include "tests/chi_square.h"
#include "tests/plant/canopy_files.h"

namespace bpms {
namespace {

// Chi-square of draws in [low, high) against a density, as a standard normal deviate.
template <class Draw, class Density>
double deviate(const Draw& draw, double low, double high, const Density& density) {
  constexpr std::size_t classes = 40, steps = 200;
  constexpr int draws = 40'000;
  std::vector<double> counts(classes, 0), expected(classes, 0);
  double sum = 0;
  for (std::size_t k = 0; k < classes * steps; ++k) {  // midpoint rule
    const double at = low + (high - low) * (static_cast<double>(k) + 0.5) / (classes * steps);
    expected[k / steps] += density(at);
    sum += density(at);
  }
  for (double& e : expected) e *= draws / sum;
  for (int k = 0; k < draws; ++k) {
    const double at = (draw() - low) / (high - low);
    EXPECT_TRUE(at >= 0 && at < 1) << at;
    counts[static_cast<std::size_t>(std::clamp(at, 0.0, 0.999999) * classes)] += 1;
  }
  return test::chi_square(counts, expected).z();
}

CloneVariation variation(const std::string& keys) {
  return CloneVariation(TomlDocument::parse("clones.toml", keys).root());
}

double turn_from(double angle, double zero) {  // into [-pi, pi)
  const double turns = (angle - zero) / (2 * pi);
  return 2 * pi * (turns - std::floor(turns + 0.5));
}

TEST(CloneVariation, RotationsAreUniform) {
  Philox random(11);
  const CloneVariation any = variation("");
  EXPECT_LT(std::abs(deviate([&] { return any.rotation(random); }, 0, 2 * pi, [](double) { return 1.0; })),
            4);
}

TEST(CloneVariation, RotationsAreVonMises) {
  for (const double kappa : {0.0, 0.5, 2.0, 50.0}) {
    SCOPED_TRACE(kappa);
    Philox random(12);
    const CloneVariation towards =
        variation(fmt::format("rotation = {{ type = \"von_mises\", mean_deg = 60, kappa = {} }}", kappa));
    EXPECT_LT(std::abs(deviate([&] { return turn_from(towards.rotation(random), radians(60)); }, -pi, pi,
                               [&](double a) { return std::exp(kappa * (std::cos(a) - 1)); })),
              4);
  }
}

TEST(CloneVariation, ScalesAreNormalWithinThreeSd) {
  Philox random(13);
  const CloneVariation sizes = variation("scale = { mean = 2, sd = 0.2 }");
  EXPECT_LT(std::abs(deviate([&] { return sizes.scale(random); }, 1.4, 2.6,
                             [](double s) { return std::exp(-0.5 * (s - 2) * (s - 2) / 0.04); })),
            4);
}

class ChoiceOfPlants : public test::CanopyFiles {};

TEST_F(ChoiceOfPlants, FollowsTheProbabilitiesOfEntriesAndFolders) {
  std::filesystem::create_directory(folder / "set");
  for (int i = 0; i < 20; ++i)
    folder.write(fmt::format("set/p{:02}.bpms", i), "units cm l l { material leaf a_length 10 a_width 1 }");
  const Canopy canopy =
      read("size_m = [20, 20]", "pattern = \"random\"\ndensity_per_m2 = 100", "",
           "[[plants]]\nfile = \"a.bpms\"\nprobability = 3\n[[plants]]\nfolder = \"set\"\nprobability = 1\n");
  std::vector<double> counts(21, 0), expected(21, 40'000 * 0.25 / 20);
  expected[0] = 40'000 * 0.75;
  for (const Placement& p : canopy.placements) counts[p.plant] += 1;
  EXPECT_LT(std::abs(test::chi_square(counts, expected).z()), 4);
  // Neighbours in the list draw independently: pairs of a and not a.
  std::vector<double> pairs(4, 0);
  for (std::size_t i = 1; i < canopy.placements.size(); i += 2)
    pairs[2 * (canopy.placements[i].plant == 0) + (canopy.placements[i - 1].plant == 0)] += 1;
  EXPECT_LT(
      std::abs(
          test::chi_square(pairs, {20'000 * 0.0625, 20'000 * 0.1875, 20'000 * 0.1875, 20'000 * 0.5625}).z()),
      4);
}

}  // namespace
}  // namespace bpms
