// Which plants stand: each of a set once, those that a stem map names, notes of many plants; the size that
// a sensor asks for.
#include "plant/plant_source.h"

#include <cmath>
#include <set>

#include "core/units.h"
#include "tests/plant/canopy_files.h"

namespace bpms {
namespace {

using enum ErrorKind;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class PlantSourceTest : public test::CanopyFiles {
 protected:
  void write_set(int plants) {
    std::filesystem::create_directory(folder / "set");
    for (int i = 0; i < plants; ++i)
      folder.write(fmt::format("set/p{:02}.bpms", i),
                   fmt::format("units cm l l {{ material leaf a_length {} a_width 1 }}", i + 1));
  }
  const std::string set = "[[plants]]\nfolder = \"set\"\n";
  const std::string once = "pattern = \"regular\"\nspacing_m = 1\nmode = \"explicit\"\n";
};

TEST_F(PlantSourceTest, EachStandsOnceInOrder) {
  write_set(12);
  const Canopy canopy = read("size_m = [4, 3]", once, "", set);
  ASSERT_EQ(canopy.placements.size(), 12u);
  ASSERT_EQ(canopy.plants.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(canopy.placements[i].plant, i);
    EXPECT_TRUE(canopy.plants[i].file.ends_with(fmt::format("p{:02}.bpms", i)));
    EXPECT_NEAR(canopy.plants[i].plant->blocks[0].attributes.length_m, 0.01 * static_cast<double>(i + 1),
                1e-12);
  }
  EXPECT_THAT(canopy.notes, IsEmpty());
}

TEST_F(PlantSourceTest, ShuffledByTheSeed) {
  write_set(12);
  const auto order = [&](const std::string& seed, const std::string& size) {
    std::vector<std::string> out;
    for (const CanopyPlant& p :
         read("size_m = " + size + "\n" + seed, once + "order = \"shuffled\"", "", set).plants)
      out.push_back(p.file.substr(p.file.size() - 8));
    return out;
  };
  const std::vector<std::string> first = order("seed = 1", "[4, 3]");
  EXPECT_EQ(std::set<std::string>(first.begin(), first.end()).size(), 12u);
  EXPECT_FALSE(std::ranges::is_sorted(first));
  EXPECT_EQ(order("seed = 1", "[4, 3]"), first);
  EXPECT_NE(order("seed = 2", "[4, 3]"), first);
  const std::vector<std::string> some = order("seed = 1", "[2, 2]");  // the first of the same order
  EXPECT_EQ(some, std::vector<std::string>(first.begin(), first.begin() + 4));
}

TEST_F(PlantSourceTest, TooFewAreRefusedWithTheNumber) {
  write_set(11);
  BPMS_EXPECT_ERROR(read("size_m = [4, 3]", once, "", set), bad_input,
                    "canopy.toml:3:1: plants: 11 plant files, expected 12");
  write_set(15);
  EXPECT_THAT(read("size_m = [4, 3]", once, "", set).notes,
              ElementsAre(HasSubstr("12 of 15 plant files stand, one at each place")));
  BPMS_EXPECT_ERROR(read("size_m = [4, 3]", once, "", set + "probability = 1\n"), bad_input,
                    "each plant stands once");
  BPMS_EXPECT_ERROR(
      read("size_m = [4, 3]", "pattern = \"regular\"\nspacing_m = 1\norder = \"listed\"", "", set), bad_input,
      "only plants that stand once have an order");
  BPMS_EXPECT_ERROR(read("size_m = [4, 3]", once, "", "[[plnts]]\nfile = \"a.bpms\"\n"), bad_input,
                    "there are no [[plants]]");
  BPMS_EXPECT_ERROR(
      read("size_m = [4, 3]", "pattern = \"regular\"\nspacing_m = 1", "", "[[plnts]]\nfile = \"a.bpms\"\n"),
      bad_input, "unknown key 'plnts'; did you mean 'plants'?");
}

TEST_F(PlantSourceTest, NotesThatAreAlikeBecomeOneWithACount) {
  std::filesystem::create_directory(folder / "set");
  for (int i = 0; i < 9; ++i)
    folder.write(fmt::format("set/p{}.bpms", i),
                 "units cm l l { material leaf a_length 10 a_width 1 } s 3 { a_length 1 }");
  const Canopy canopy = read("size_m = [4, 3]", "pattern = \"regular\"\nspacing_m = 1", "", set);
  std::vector<std::string> expected = canopy.plants[0].plant->warnings;
  ASSERT_FALSE(expected.empty());
  for (std::string& note : expected) note += " (and the same of 8 more plants)";
  EXPECT_EQ(canopy.notes, expected);
}

TEST_F(PlantSourceTest, TheFirstBadFileIsTheOneThatIsNamed) {
  write_set(40);
  folder.write("set/p07.bpms", "units cm l l { material leaf a_lenght 3 }");
  folder.write("set/p30.bpms", "units cm [l");
  for (int k = 0; k < 5; ++k)
    BPMS_EXPECT_ERROR(read("size_m = [8, 5]", once, "", set), bad_input, "p07.bpms:1:");
}

TEST_F(PlantSourceTest, StemMapsNameTheirPlants) {
  folder.write(
      "stems.csv",
      "tree,x_m,y_m,z_m,rotation_deg,scale,plant\n1,0.5,0.25,0.1,90,1.5,b.bpms\n2,-0.5,-0.25,,,,a.bpms\n"
      "3,0.1,0.2,0,,,b.bpms\n");
  const Canopy canopy = read("size_m = [4, 3]", "pattern = \"list\"\ntable = \"stems.csv\"", "", "");
  ASSERT_EQ(canopy.placements.size(), 3u);
  ASSERT_EQ(canopy.plants.size(), 2u);
  EXPECT_TRUE(canopy.plants[canopy.placements[0].plant].file.ends_with("b.bpms"));
  EXPECT_EQ(canopy.placements[2].plant, canopy.placements[0].plant);
  EXPECT_TRUE(canopy.plants[canopy.placements[1].plant].file.ends_with("a.bpms"));
  EXPECT_LT((canopy.placements[0].position_m - Eigen::Vector3d(0.5, 0.25, 0.1)).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(canopy.placements[0].rotation, pi / 2);
  EXPECT_DOUBLE_EQ(canopy.placements[0].scale, 1.5);
  EXPECT_DOUBLE_EQ(canopy.placements[1].scale, 1);
  EXPECT_THAT(canopy.inputs, Contains(HasSubstr("stems.csv")));
  EXPECT_THAT(canopy.inputs, Contains(HasSubstr("b.bpms")));
}

TEST_F(PlantSourceTest, StemsWithoutAPlantDrawOne) {
  folder.write("stems.csv", "x_m,y_m,plant\n0.5,0.25,b.bpms\n0,0,\n0.2,0.1,\n");
  const Canopy canopy = read("size_m = [4, 3]", "pattern = \"list\"\ntable = \"stems.csv\"");
  EXPECT_TRUE(canopy.plants[canopy.placements[0].plant].file.ends_with("b.bpms"));
  EXPECT_EQ(canopy.placements[1].plant, 0u);
  // Of a set those that are drawn stand once, beside those that are named.
  write_set(2);
  const Canopy once_each =
      read("size_m = [4, 3]", "pattern = \"list\"\ntable = \"stems.csv\"\nmode = \"explicit\"", "", set);
  ASSERT_EQ(once_each.plants.size(), 3u);
  EXPECT_EQ(once_each.placements[0].plant, 2u);
  EXPECT_EQ(once_each.placements[1].plant, 0u);
  EXPECT_EQ(once_each.placements[2].plant, 1u);
}

TEST_F(PlantSourceTest, StemMapsAreReadWithTheirPlaces) {
  const auto refused = [&](const std::string& csv, const char* message, const std::string& plants) {
    SCOPED_TRACE(message);
    folder.write("stems.csv", csv);
    BPMS_EXPECT_ERROR(read("size_m = [4, 3]", "pattern = \"list\"\ntable = \"stems.csv\"", "", plants),
                      bad_input, message);
  };
  refused("x_m,z_m\n1,2\n", "y_m", "");
  refused("x_m,y_m,plant\n1,2,c.bpms\n", "stems.csv:2:5: there is no plant file", "");
  refused("x_m,y_m,scale,plant\n1,2,-1,b.bpms\n", "stems.csv:2:5: scale -1, expected a factor above 0", "");
  refused("x_m,y_m,plant\n1,2,b.bpms\n1,x,b.bpms\n", "stems.csv:3:3", "");
  refused("x_m,y_m,plant\n1,2,b.bpms\n1,1,\n", "1 places name no plant: expected [[plants]]", "");
  refused("x_m,y_m\n1,2\n", "missing key 'plants'", "");
  refused("x_m,y_m,plant\n", "no plants in the stem map", "");
  refused("x_m,y_m\n1e8,2\n", "beyond 1e7 m", "[[plants]]\nfile = \"a.bpms\"\n");
  BPMS_EXPECT_ERROR(read("size_m = [4, 3]", "pattern = \"list\""), bad_input,
                    "expected one of positions and table");
}

TEST_F(PlantSourceTest, ExtentsComeFromTheSensor) {
  const std::string random = "pattern = \"random\"\ndensity_per_m2 = 1";
  const Canopy canopy =
      read("boundary = \"open\"\nextent_for = { height_m = 3, fov_deg = 20, zenith_deg = 45 }", random);
  const double side = 2 * 3.5 * 3 * std::tan(radians(55));
  EXPECT_NEAR(canopy.size_m.x(), side, 1e-9);
  EXPECT_NEAR(canopy.size_m.y(), side, 1e-9);
  EXPECT_EQ(canopy.placements.size(), static_cast<std::size_t>(std::llround(side * side)));
  EXPECT_THAT(canopy.notes,
              ElementsAre(HasSubstr("3.5 times the 4.28444 m from the point below a sensor 3 m up")));
  const Canopy down =
      read("boundary = \"open\"\nextent_for = { height_m = 10, fov_deg = 90, factor = 4 }", random);
  EXPECT_NEAR(down.size_m.x(), 80, 1e-9);
  const auto refused = [&](const std::string& domain, const char* message) {
    SCOPED_TRACE(message);
    BPMS_EXPECT_ERROR(read(domain, random), bad_input, message);
  };
  refused("boundary = \"open\"\nextent_for = { height_m = 3, fov_deg = 60, zenith_deg = 60 }",
          "reaches 90 degrees, to the horizon or beyond");
  refused("extent_for = { height_m = 3, fov_deg = 60 }", "a periodic canopy has no end");
  refused("boundary = \"open\"\nsize_m = [1, 1]\nextent_for = { height_m = 3, fov_deg = 60 }",
          "give one of the two");
  refused("boundary = \"open\"\nextent_for = { height_m = 3, fov_deg = 60, factor = 0.5 }", "from 1 to 1000");
  refused("boundary = \"open\"\nextent_for = { height_m = 3, fov_deg = 0 }", "has no extent");
  refused("boundary = \"open\"\nextent_for = { height_m = 3, fov_deg = 60, zentih_deg = 1 }",
          "did you mean 'zenith_deg'?");
}

}  // namespace
}  // namespace bpms
