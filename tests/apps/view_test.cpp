// bpms view: what it refuses, what it writes, and the page as a browser shows it.
#include <gmock/gmock.h>

#include "core/json.h"
#include "core/text.h"
#include "tests/apps/refused.h"
#include "tests/command.h"

namespace bpms::test {
namespace {

const std::string view_grass = "view grass.bpms -o new.png --size 80x80 --no-legend --no-scale-bar ";

INSTANTIATE_TEST_SUITE_P(
    View, Refused,
    ::testing::ValuesIn(std::vector<Refusal>{
        Refusal{"NoOutput", as_it_is(), "view grass.bpms", 2, "no output file", {"-o FILE"}},
        Refusal{"UnknownFormat", as_it_is(), "view grass.bpms -o new.gif", 2, "new.gif: ", {".png", ".html"}},
        Refusal{"UnknownView",
                as_it_is(),
                view_grass + "--views fornt",
                2,
                "--views: ",
                {"did you mean 'front'"}},
        Refusal{"UnknownColour",
                as_it_is(),
                view_grass + "--colour lenght",
                2,
                "--colour: ",
                {"did you mean 'length'"}},
        Refusal{"UnknownColourOfAPage",
                as_it_is(),
                "view grass.bpms -o new.html --colour age",
                2,
                "--colour: ",
                {"'age'"}},
        Refusal{"SizeWithoutHeight",
                as_it_is(),
                "view grass.bpms -o new.png --size 200",
                2,
                "--size: ",
                {"1200x900"}},
        Refusal{"NoRoom", as_it_is(), "view grass.bpms -o new.png --size 64x64", 2, "--size: ", {"no room"}},
        Refusal{"Tolerance", as_it_is(), view_grass + "--tolerance 1", 2, "--tolerance: ", {"no unit"}},
        Refusal{"ViewsAndAzimuth", as_it_is(), view_grass + "--views top --azimuth 3", 2, "", {"--azimuth"}},
        Refusal{"OutputThere", written("new.png", "mine"), view_grass, 2, "new.png", {"--overwrite"}},
        Refusal{"OneOfManyThere",
                written("new_top.png", "mine"),
                "view grass.bpms --views front,top -o new_{view}.png",
                2,
                "new_top.png",
                {"--overwrite"}},
        Refusal{"NothingToSee",
                written("grass.bpms", "[s[l]]\n"),
                view_grass,
                2,
                "grass.bpms: ",
                {"nothing to see"}},
        Refusal{"AbsentMesh", as_it_is(), "view none.obj -o new.png", 3, "none.obj: ", {}}}),
    name_of_case);

TEST(View, AFileForEachView) {
  const SoundFolder folder;
  const Outcome done = run_bpms(
      folder, "view grass.bpms --views front,top --size 120x120 --no-legend -o new_{view}.png --json");
  ASSERT_EQ(done.code, 0) << done.error;
  const Json report = Json::parse(done.out);
  ASSERT_EQ(report["pictures"].size(), 2u);
  EXPECT_EQ(report["pictures"][1]["file"], "new_top.png");
  for (const char* file : {"new_front.png", "new_top.png"})
    EXPECT_EQ(read_file(folder / file).substr(0, 4), "\x89PNG") << file;
}

TEST(View, EveryKindOfFile) {
  const SoundFolder folder;
  for (const char* file : {"grass.bpms", "canopy.toml", "scene.toml", "planted.toml", "leaf.obj"}) {
    const Outcome picture =
        run_bpms(folder, std::string("view ") + file +
                             " --size 120x120 --no-legend --samples 1 -o new.png --overwrite");
    EXPECT_EQ(picture.code, 0) << file << ": " << picture.error;
    const Outcome page = run_bpms(folder, std::string("view ") + file + " -o new.html --overwrite");
    EXPECT_EQ(page.code, 0) << file << ": " << page.error;
    EXPECT_THAT(read_file(folder / "new.html"), ::testing::Not(::testing::HasSubstr("__BPMS_DATA__")))
        << file;
  }
}

bool have(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

// Two balls and a pole on the ground; seen from above, each is where it stands.
TEST(View, ThePageInABrowser) {
  if (!have("node") || !have("${CHROMIUM:-chromium}")) {
    if (data_required()) FAIL() << "node and chromium are required";
    GTEST_SKIP() << "needs node and chromium";
  }
  const TemporaryFolder folder;
  folder.write("ball.bpms", "units cm\nb\nb { material leaf a_radius 5 }\n");
  folder.write("pole.bpms", "units cm\ns\ns { material stem a_length 20 a_radius 2 }\n");
  folder.write("scene.toml", R"([domain]
size_m = [0.8, 0.6]
[ground]
type = "plane"
material = "soil"
[materials]
soil = { type = "lambertian", reflectance = 0.2 }
leaf = { type = "lambertian", reflectance = 0.2 }
stem = { type = "lambertian", reflectance = 0.2 }
[prototypes]
ball = { plant = "ball.bpms" }
pole = { plant = "pole.bpms" }
[[instances]]
prototype = "ball"
positions = [[-0.2, 0, 0], [0, 0.2, 0]]
[[instances]]
prototype = "pole"
positions = [[0.2, 0, 0]]
)");
  // A ball has the larger area (314 to 276 cm2): yellow at the scale's high end, the pole purple at its low
  // one.
  folder.write("facts.json", R"({
"counts": {"instances": 3, "prototypes": 2},
"points": [{"at": [-0.2, 0, 0.1], "label": "b1", "plant": "ball", "kind": "bud", "parameter": "a_radius"},
           {"at": [0, 0.2, 0.1], "label": "b1", "plant": "ball", "kind": "bud"},
           {"at": [0.2, 0, 0.2], "label": "s1", "plant": "pole", "kind": "stem", "parameter": "a_length"},
           {"at": [0.3, 0.2, 0], "label": "ground", "plant": "ground", "kind": "ground"}],
"colours": [{"by": "area", "at": [-0.2, 0, 0.1], "order": [0, 1, 2]},
            {"by": "area", "at": [0.2, 0, 0.2], "order": [2, 0, 1]},
            {"by": "material", "at": [-0.2, 0, 0.1], "order": [1, 2, 0]}],
"cut": {"section": {"axis": "x", "place": 0.5, "upper": true}, "hidden": [-0.2, 0, 0.1], "shown": [0.2, 0, 0.2]}
})");
  const Outcome made = run_bpms(folder, "view scene.toml -o scene.html");
  ASSERT_EQ(made.code, 0) << made.error;
  const std::string command = fmt::format(
      "cd '{0}' && timeout 300 node '{1}/workbench/scripts/check_viewer.mjs' scene.html facts.json >out 2>&1",
      folder / ".", BPMS_SOURCE_DIR);
  const int status = std::system(command.c_str());
  EXPECT_EQ(exit_code_of(status), 0) << read_file(folder / "out");
}

}  // namespace
}  // namespace bpms::test
