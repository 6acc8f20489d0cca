// The verb as users run it: exit codes, error lines, files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include "core/json.h"
#include "core/text.h"
#include "plant/plant.h"
#include "tests/data.h"
#include "tests/fit/leaf.h"

namespace bpms {
namespace {

using ::testing::HasSubstr;

struct Outcome {
  int code = 0;
  std::string error;
};

Outcome bpms_fit(const test::TemporaryFolder& folder, const std::string& arguments) {
  const std::string command =
      std::string(BPMS_BINARY_DIR) + "/bpms fit " + arguments + " 2> '" + (folder / "error.txt") + "'";
  const int status = std::system(command.c_str());
  std::ifstream file(folder / "error.txt");
  return {WEXITSTATUS(status), {std::istreambuf_iterator<char>(file), {}}};
}

std::string leaves_csv(const std::string& header, int leaves) {
  std::string out = header + "\n";
  for (int leaf = 1; leaf <= leaves; ++leaf)
    for (int k = 0; k < 8; ++k)
      out += fmt::format("{},{},{},{}\n", leaf, k * k * 0.2, 3 * k - 0.1 * k * k, leaf % 2);
  return out;
}

std::string quoted(const std::string& text) {
  return "'" + text + "'";
}

TEST(FitVerb, TableToPlantAndReport) {
  const test::TemporaryFolder folder;
  const std::string input = folder.write("t.csv", leaves_csv("leaf,x,y,p", 4));
  const std::string columns =
      " --columns leaf=leaf,x=x,z=y --unit cm --function p:3 --report " + quoted(folder / "fit.json");
  ASSERT_EQ(bpms_fit(folder, quoted(input) + columns + " -o " + quoted(folder / "out.bpms")).code, 0);
  const Plant plant = read_plant(folder / "out.bpms");
  EXPECT_EQ(place_organs(plant).size(), 4u);
  const Json report = Json::parse(read_text(folder / "fit.json"));
  EXPECT_EQ(report["summary"]["organs"], 4);
  EXPECT_EQ(report["organs"][3]["functions"]["inclination"]["coefficients"].size(), 4u);
  EXPECT_TRUE(report["organs"][0]["chi2_per_dof"].is_null());
  EXPECT_EQ(report["provenance"]["inputs"].size(), 1u);
  // An output that exists is refused.
  EXPECT_NE(bpms_fit(folder, quoted(input) + columns + " -o " + quoted(folder / "out.bpms")).code, 0);
}

TEST(FitVerb, SeveralPlantsGoToAFolder) {
  const test::TemporaryFolder folder;
  const std::string input = quoted(folder.write("t.csv", leaves_csv("leaf,x,y,p", 4)));
  const std::string columns = " --columns plant=p,leaf=leaf,x=x,z=y --unit cm --function p:2 ";
  EXPECT_THAT(bpms_fit(folder, input + columns + "-o " + quoted(folder / "out.bpms")).error,
              HasSubstr("2 plants"));
  ASSERT_EQ(bpms_fit(folder, input + columns + "-o " + quoted(folder / "plants")).code, 0);
  EXPECT_EQ(place_organs(read_plant(folder / "plants/0.bpms")).size(), 2u);
  EXPECT_EQ(place_organs(read_plant(folder / "plants/1.bpms")).size(), 2u);
}

TEST(FitVerb, BadInputIsNamedAndLeavesNothingBehind) {
  const test::TemporaryFolder folder;
  const std::string input = quoted(folder.write("t.csv", leaves_csv("leaf,x,y,p", 2)));
  const std::string out = " -o " + quoted(folder / "out.bpms");
  const auto expect = [&](const std::string& arguments, int code, const std::string& part) {
    const Outcome outcome = bpms_fit(folder, arguments + out);
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
  expect(quoted(folder / "absent.csv"), 3, "absent.csv");
  const std::string few = quoted(folder.write("few.csv", "leaf,x,y\n1,0,0\n1,1,1\n1,2,1\n"));
  expect(few + " --columns leaf=leaf,x=x,z=y --unit cm", 2, "3 midrib points");
  const std::string same = quoted(folder.write("same.csv", "leaf,x,y\n1,0,0\n1,0,0\n1,0,0\n1,0,0\n1,0,0\n"));
  expect(same + " --columns leaf=leaf,x=x,z=y --unit cm", 2, "different places");
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
  const std::string input = quoted(folder.write("v.csv", vectors_csv(points)));
  const Outcome outcome = bpms_fit(
      folder, input + " --json -o " + quoted(folder / "out.bpms") + " > " + quoted(folder / "out.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_THAT(outcome.error, HasSubstr("organ 'pot': 1 points left out"));
  EXPECT_THAT(outcome.error, HasSubstr("rank 2 leaf: not fitted"));
  const Json report = Json::parse(read_text(folder / "out.json"));
  EXPECT_EQ(report["summary"]["failed"], 1);
  EXPECT_TRUE(report["organs"][1]["length_m"].is_null());
  EXPECT_TRUE(report["organs"][1]["id"].is_null());
  EXPECT_GT(report["organs"][0]["width_m"].get<double>(), 0.01);
  EXPECT_EQ(place_organs(read_plant(folder / "out.bpms")).size(), 1u);
}

}  // namespace
}  // namespace bpms
