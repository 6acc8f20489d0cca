// Libraries of constants, organs and blocks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "plant/canopy.h"
#include "plant/plant.h"
#include "plant/plant_library.h"
#include "tests/data.h"

namespace bpms {
namespace {

using enum ErrorKind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A plant whose files are in memory.
Plant parse(const std::string& text, const std::map<std::string, std::string>& files) {
  PlantReadOptions options;
  options.include = [&](const std::string& path) {
    const auto found = files.find(path);
    if (found == files.end()) fail(missing_resource, {path}, "no such file");
    return found->second;
  };
  return parse_plant("d/x.bpms", text, options);
}

TEST(Include, BringsConstantsOrgansAndBlocks) {
  const Plant plant =
      parse("units cm include \"lib/organs.bpms\" [s[+l]c] c { organ tip size (w) } + { a_twist (w) }",
            {{"d/lib/organs.bpms",
              "units mm\ninclude \"more.bpms\"\norgan tip(size) { h h { a_length (size) a_radius 1 } }\n"
              "s { a_length 30 a_radius 1 } l 1 { a_length (w) a_width 2 } l 9 { a_length 1 a_width 1 }"},
             {"d/lib/more.bpms", "let w = 20"}});
  EXPECT_EQ(plant.unit, "cm");
  EXPECT_THAT(plant.inputs, ElementsAre("d/x.bpms", "d/lib/organs.bpms", "d/lib/more.bpms"));
  const std::vector<PlacedOrgan> organs = place_organs(plant);
  ASSERT_EQ(organs.size(), 3u);
  EXPECT_DOUBLE_EQ(organs[0].attributes->length_m, 0.03);  // its file's unit
  EXPECT_DOUBLE_EQ(organs[1].attributes->length_m, 0.02);
  EXPECT_DOUBLE_EQ(organs[2].attributes->length_m, 0.02);
  // Blocks that nothing uses are there to choose from: no note, and not written.
  EXPECT_THAT(plant.warnings,
              ElementsAre("d/x.bpms:1:55: organ 'tip' is defined in a file with units mm, this one has units "
                          "cm: its parameters are numbers, taken as that file takes them"));
  const std::string text = plant_text(plant);
  EXPECT_THAT(text, testing::Not(HasSubstr("l 9")));
  EXPECT_EQ(plant_text(parse_plant("y.bpms", text)), text);
}

TEST(Include, WhatIsIncludedTwiceIsReadOnce) {
  const Plant plant =
      parse("include \"a.bpms\" include \"b.bpms\" include \"./a.bpms\" s s { a_length (k) a_radius 1 }",
            {{"d/a.bpms", "let k = 4"}, {"d/b.bpms", "include \"../d/a.bpms\""}});
  EXPECT_DOUBLE_EQ(plant.blocks[0].attributes.length_m, 0.04);
  EXPECT_THAT(plant.inputs, ElementsAre("d/x.bpms", "d/a.bpms", "d/b.bpms"));
}

TEST(Include, ErrorsNameTheFile) {
  const auto refused = [](const std::string& text, const std::map<std::string, std::string>& files,
                          ErrorKind kind, const std::string& part) {
    try {
      parse(text, files);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), kind) << error.what();
      EXPECT_THAT(error.what(), HasSubstr(part));
    }
  };
  refused("include \"none.bpms\" s", {}, missing_resource,
          "d/x.bpms:1:9: included file 'd/none.bpms': no such file");
  refused("include none.bpms s", {}, bad_input,
          "d/x.bpms:1:9: syntax error: expected a file's name in quotes");
  refused("include \"none.bpms s", {}, bad_input,
          "d/x.bpms:1:9: syntax error: string opened here is never closed");
  refused("include \"a.bpms\" s", {{"d/a.bpms", "let b = 2\nlet a = (1 / 0)"}}, bad_input,
          "d/a.bpms:2:12: semantic error: division by zero");
  refused("include \"a.bpms\" s", {{"d/a.bpms", "include \"b.bpms\""}, {"d/b.bpms", "\ninclude \"a.bpms\""}},
          bad_input,
          "d/b.bpms:2:9: semantic error: files include each other: d/a.bpms -> d/b.bpms -> d/a.bpms");
  refused("include \"x.bpms\" s", {}, bad_input, "files include each other: d/x.bpms -> d/x.bpms");
  refused("include \"a.bpms\" s", {{"d/a.bpms", "[s]"}}, bad_input,
          "d/a.bpms:1:1: syntax error: found '[s]', expected let, organ, include or a block; a file that is "
          "included holds no word");
  refused("include \"a.bpms\" s s { a_length 1 a_radius 1 }", {{"d/a.bpms", "s { a_length 3 a_radius 1 }"}},
          bad_input, "d/x.bpms:1:20: semantic error: a second block 's'; the first is at d/a.bpms:1:1");
  refused("include \"a.bpms\" c c { organ o }", {{"d/a.bpms", "organ o { l l { a_length (k) } }"}}, bad_input,
          "d/a.bpms:1:27: semantic error: unknown name 'k'");
  refused("include \"a.bpms\" let k = 1 s", {{"d/a.bpms", "let k = 1"}}, bad_input,
          "d/x.bpms:1:22: semantic error: a second 'k'; the first is at d/a.bpms:1:5");
}

TEST(Include, ReadsFilesBesideTheirFile) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "lib");
  folder.write("lib/blades.bpms", "l { a_length 20 a_width 1 }\n");
  const std::string path =
      folder.write("p.bpms", "include \"lib/blades.bpms\" [s[l]] s { a_length 1 a_radius 0.1 }\n");
  EXPECT_THAT(read_plant(path).inputs, ElementsAre(path, folder / "lib/blades.bpms"));
  const std::string canopy =
      folder.write("canopy.toml",
                   "[domain]\nsize_m = [1, 1]\n[[plants]]\nfile = \"p.bpms\"\n[planting]\n"
                   "pattern = \"random\"\ndensity_per_m2 = 3\n");
  EXPECT_THAT(read_canopy(canopy).inputs, testing::IsSupersetOf({path, folder / "lib/blades.bpms"}));
}

TEST(Include, ALibraryIsCheckedByItself) {
  const auto library =
      parse_plant_library("l.bpms",
                          "units mm let a = 1 organ o(x) { l l { a_length (x) a_width (a) } }\n"
                          "l 3 { a_length 4 a_width 1 } c { organ o x 3 } let b = 2");
  ASSERT_TRUE(library);
  EXPECT_THAT(library->constants, ElementsAre("a", "b"));
  EXPECT_THAT(library->organs, ElementsAre("o"));
  EXPECT_EQ(library->blocks, 2u);
  EXPECT_FALSE(parse_plant_library("p.bpms", "let a = 1 s s { a_length (a) }"));
  EXPECT_FALSE(parse_plant_library("p.bpms", "l { a_length 1 }"));  // a plant that lacks its word
  BPMS_EXPECT_ERROR(parse_plant_library("l.bpms", "let a = 1 c { organ o }"), bad_input, "unknown organ 'o'");
  BPMS_EXPECT_ERROR(parse_plant_library("l.bpms", "organ o(x) { l l { a_length (y) } }"), bad_input,
                    "l.bpms:1:30: semantic error: unknown name 'y'");
}

}  // namespace
}  // namespace bpms
