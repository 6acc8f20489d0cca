// What describe refuses of its options, and what it writes.
#include <gmock/gmock.h>

#include "core/csv.h"
#include "core/json.h"
#include "core/text.h"
#include "tests/apps/refused.h"
#include "tests/command.h"

namespace bpms::test {
namespace {

using ::testing::HasSubstr;

Refusal option(const std::string& name, const std::string& options, const std::string& begin,
               const std::vector<std::string>& holds) {
  return {name, as_it_is(), describe + " " + options, 2, begin, holds};
}

INSTANTIATE_TEST_SUITE_P(
    DescribeOptions, Refused,
    ::testing::Values(
        option("ZenithBelowTheHorizon", "--zenith 0,95", "--zenith: '95'", {"a number from 0 to 89.9"}),
        option("ZenithOfWords", "--zenith 0,x", "--zenith: 'x'", {"number"}),
        option("NoSectors", "--azimuths 0", "", {"--azimuths", "1 to 360"}),
        option("NoLayers", "--layers 0", "", {"--layers"}),
        option("NoTarget", "--target-se 0", "", {"--target-se"}),
        option("LeavesThatShine", "--rho 0.7 --tau 0.5", "--rho and --tau of 'leaf' add to 1.2",
               {"more than 1"}),
        option("NegativeReflectance", "--rho=-0.1", "--rho: '-0.1'", {"from 0 to 1"}),
        option("MaterialWithoutLeaves", "--rho stem=0.1", "--rho: no leaves are of material 'stem'", {}),
        option("TwoOptics", "--rho 0.1 --materials scene.toml", "--materials and --rho, --tau",
               {"choose one"}),
        option("PlaceWithoutPicture", "--fisheye-at 0,0", "--fisheye-at needs --fisheye", {}),
        option("PlaceOfOneNumber", "--fisheye 32 --fisheye-at 0", "--fisheye-at: expected X,Y", {}),
        option("LeavesOfACanopy", "--leaves foliage", "--leaves, --unit and --up are for mesh files", {}),
        Refusal{"LeavesThatAreNotThere",
                as_it_is(),
                "describe leaf.obj --rays 64 --leaves foliage",
                2,
                "leaf.obj: no group and no material is called 'foliage'",
                {}},
        Refusal{"UnitOfTime", as_it_is(), "describe leaf.obj --rays 64 --unit s", 2, "", {"'s'"}}),
    name_of_case);

TEST(Describe, WritesItsTableAndItsReport) {
  const SoundFolder folder;
  const Outcome run =
      run_bpms(folder, describe + " --azimuths 4 --rho 0.1 --tau 0.05 --fisheye 32 -o new.csv --json");
  ASSERT_EQ(run.code, 0) << run.error;
  const Json report = Json::parse(run.out);
  EXPECT_GT(report.at("lai"), 0);
  EXPECT_EQ(report.at("gap_by_azimuth").size(), 4 * report.at("gap_fraction").size());
  EXPECT_EQ(report.at("area_scattering").at("tables").size(), 3u);
  EXPECT_THAT(report.at("fisheye").at("data_uri").get<std::string>(), HasSubstr("data:image/png;base64,"));
  const CsvTable table = CsvTable::read(folder / "new.csv");
  EXPECT_GT(table.rows(), 100u);
}

// Two upright plates at right angles through each other: all triangles that reach the middle cross. Apart,
// none does. Without the leaves nothing is left to cross.
TEST(Describe, TellsOverlapBetweenPlants) {
  const SoundFolder folder;
  folder.write("plate.bpms", "units cm\nl\nl { material green a_length 10 a_width 4 }\n");
  const auto overlap = [&](const std::string& positions) {
    folder.write("two.toml",
                 "[domain]\nsize_m = [1, 1]\n[[plants]]\nfile = \"plate.bpms\"\n[planting]\npattern = "
                 "\"list\"\npositions = " +
                     positions + "\n");
    const Outcome run = run_bpms(folder, "describe two.toml --rays 64 --overlap --json");
    EXPECT_EQ(run.code, 0) << run.error;
    return Json::parse(run.out).at("overlap").get<double>();
  };
  EXPECT_GT(overlap("[[0.005, 0.005, 0, 0], [0, 0, 0, 90]]"), 0.1);
  EXPECT_EQ(overlap("[[0, 0, 0, 0], [0.3, 0, 0, 90]]"), 0);
  EXPECT_EQ(run_bpms(folder, "describe plate.bpms --rays 64 --overlap").code, 2);
}

TEST(Describe, LeavesMaterialsOut) {
  const SoundFolder folder;
  folder.write("two.bpms",
               "units cm\n[l(1)][l(2)]\nl 1 { material green a_length 10 a_width 4 }\n"
               "l 2 { material dead a_length 5 a_width 4 }\n");
  const auto area = [&](const std::string& without) {
    const Outcome run = run_bpms(folder, "describe two.bpms --rays 64 --json " + without);
    EXPECT_EQ(run.code, 0) << run.error;
    return Json::parse(run.out).at("leaf_area_m2").get<double>();
  };
  EXPECT_NEAR(area(""), 60e-4, 1e-7);
  EXPECT_NEAR(area("--without dead"), 40e-4, 1e-7);
  const Outcome wrong = run_bpms(folder, "describe two.bpms --rays 64 --without deed");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.error, HasSubstr("did you mean 'dead'?"));
}

TEST(Describe, TakesAMeshAsItIs) {
  const SoundFolder folder;
  const Outcome run = run_bpms(folder, "describe leaf.obj --rays 64 --json");
  ASSERT_EQ(run.code, 0) << run.error;
  const Json report = Json::parse(run.out);
  EXPECT_EQ(report.at("ground_area_of"), "convex_hull");
  EXPECT_GT(report.at("leaf_area_m2").get<double>() + report.at("other_area_m2").get<double>(), 0);
}

}  // namespace
}  // namespace bpms::test
