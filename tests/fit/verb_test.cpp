// The verb as users run it: exit codes, error lines, files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/json.h"
#include "plant/plant.h"
#include "tests/command.h"
#include "tests/fit/leaf.h"

namespace bpms {
namespace {

using test::Outcome, test::run_bpms;
using ::testing::HasSubstr;

std::string leaves_csv(const std::string& header, int leaves) {
  std::string out = header + "\n";
  for (int leaf = 1; leaf <= leaves; ++leaf)
    for (int k = 0; k < 8; ++k)
      out += fmt::format("{},{},{},{}\n", leaf, k * k * 0.2, 3 * k - 0.1 * k * k, leaf % 2);
  return out;
}

TEST(FitVerb, TableToPlantAndReport) {
  const test::TemporaryFolder folder;
  folder.write("t.csv", leaves_csv("leaf,x,y,p", 4));
  const std::string fit =
      "fit t.csv --columns leaf=leaf,x=x,z=y --unit cm --function p:3 --report fit.json -o out.bpms";
  ASSERT_EQ(run_bpms(folder, fit).code, 0);
  const Plant plant = read_plant(folder / "out.bpms");
  EXPECT_EQ(place_organs(plant).size(), 4u);
  const Json report = Json::parse(read_file(folder / "fit.json"));
  EXPECT_EQ(report["summary"]["organs"], 4);
  EXPECT_EQ(report["organs"][3]["functions"]["inclination"]["coefficients"].size(), 4u);
  EXPECT_TRUE(report["organs"][0]["chi2_per_dof"].is_null());
  EXPECT_EQ(report["provenance"]["inputs"].size(), 1u);
  EXPECT_EQ(run_bpms(folder, fit).code, 2);  // an output that exists is refused
}

TEST(FitVerb, SeveralPlantsGoToAFolder) {
  const test::TemporaryFolder folder;
  folder.write("t.csv", leaves_csv("leaf,x,y,p", 4));
  const std::string fit = "fit t.csv --columns plant=p,leaf=leaf,x=x,z=y --unit cm --function p:2 -o ";
  EXPECT_THAT(run_bpms(folder, fit + "out.bpms").error, HasSubstr("2 plants"));
  ASSERT_EQ(run_bpms(folder, fit + "plants/").code, 0);
  EXPECT_EQ(place_organs(read_plant(folder / "plants/0.bpms")).size(), 2u);
  EXPECT_EQ(place_organs(read_plant(folder / "plants/1.bpms")).size(), 2u);
  EXPECT_THAT(run_bpms(folder, fit + "plants").error, HasSubstr("plants/0.bpms: exists already"));
  std::filesystem::create_directory(folder / "empty");
  EXPECT_EQ(run_bpms(folder, fit + "empty").code, 0);  // a folder that is there is as good as a new one
  EXPECT_TRUE(std::filesystem::exists(folder / "empty/1.bpms"));
}

TEST(FitVerb, BadInputIsNamedAndLeavesNothingBehind) {
  const test::TemporaryFolder folder;
  const std::string input = "t.csv";
  folder.write(input, leaves_csv("leaf,x,y,p", 2));
  const auto expect = [&](const std::string& arguments, int code, const std::string& part) {
    const Outcome outcome = run_bpms(folder, "fit " + arguments + " -o out.bpms");
    EXPECT_EQ(outcome.code, code) << outcome.error;
    EXPECT_THAT(outcome.error, HasSubstr("error: "));
    EXPECT_THAT(outcome.error, HasSubstr(part));
    EXPECT_FALSE(std::filesystem::exists(folder / "out.bpms"));
  };
  expect(input + " --columns leaf=leaf,x=x,z=y", 2, "--unit");
  expect(input + " --columns leaf=leaf,x=x,z=y --unit parsec", 2, "parsec");
  expect(input + " --columns leaf=lea,x=x,z=y --unit cm", 2, "leaf");
  expect(input + " --columns leaf=leaf,x=x,z=y --unit cm --dialect de", 2, "de");
  expect(input + " --columns leaf=leaf,x=x,z=y --unit cm --function p:99", 2, "p:99");
  expect(input, 2, "plant");
  expect(input + " --unit cm", 2, "--columns");
  expect("absent.csv", 3, "absent.csv");
  folder.write("few.csv", "leaf,x,y\n1,0,0\n1,1,1\n1,2,1\n");
  expect("few.csv --columns leaf=leaf,x=x,z=y --unit cm", 2, "3 midrib points");
  folder.write("same.csv", "leaf,x,y\n1,0,0\n1,0,0\n1,0,0\n1,0,0\n1,0,0\n");
  expect("same.csv --columns leaf=leaf,x=x,z=y --unit cm", 2, "different places");
}

TEST(FitVerb, VectorsWithAPotAndAFailedLeaf) {
  const test::TemporaryFolder folder;
  Philox random(21);
  SyntheticLeaf leaf = test::arching_leaf();
  leaf.edge_points = 8;
  std::vector<VectorPoint> points;
  const MeasuredOrgan organ = measure(leaf, {.sigma_m = 3e-4}, random);
  for (const auto* list : {&organ.midrib, &organ.edge_left, &organ.edge_right})
    points.insert(points.end(), list->begin(), list->end());
  VectorPoint other = points[0];
  other.label = {"1", "1", 2, "leaf", "midrib"};
  points.push_back(other);
  other.label = {"1", "1", 0, "pot", "outline"};
  points.push_back(other);
  folder.write("v.csv", vectors_csv(points));
  const Outcome outcome = run_bpms(folder, "fit v.csv --json -o out.bpms");
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_THAT(outcome.error, HasSubstr("organ 'pot': 1 points left out"));
  EXPECT_THAT(outcome.error, HasSubstr("rank 2 leaf: not fitted"));
  const Json report = Json::parse(outcome.out);
  EXPECT_EQ(report["summary"]["failed"], 1);
  EXPECT_TRUE(report["organs"][1]["length_m"].is_null());
  EXPECT_TRUE(report["organs"][1]["id"].is_null());
  EXPECT_GT(report["organs"][0]["width_m"].get<double>(), 0.01);
  EXPECT_EQ(place_organs(read_plant(folder / "out.bpms")).size(), 1u);
}

}  // namespace
}  // namespace bpms
