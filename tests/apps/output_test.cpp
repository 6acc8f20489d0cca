// Outputs that cannot be written: refused before the work where that can be known, and never left in half.
#include <gmock/gmock.h>

#include "tests/apps/refused.h"
#include "tests/command.h"

namespace bpms::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

struct Writer {
  std::string name, arguments;  // without the output
};

std::vector<Refusal> rows() {
  const std::vector<Writer> writers{
      {"Calibrate", "calibrate --corners corners.vnl --image-size 640x480 --target board.toml -o "},
      {"Reconstruct", "reconstruct points.csv --rig rig.toml -o "},
      {"Fit", "fit vectors.csv -o "},
      {"Build", "build grass.bpms -o "},
      {"BuildAlso", "build grass.bpms -o new.ply --also "},
      {"Simulate", "simulate scene.toml -o "},
      {"SimulateCsv", "simulate scene.toml -o new.nc --csv "},
      {"ReportPage", "report fit.json -o "},
  };
  std::vector<Refusal> out;
  const Edit there = written("there.bpms.ply", "kept");
  for (const auto& [name, arguments] : writers) {
    out.push_back({name + "OntoWhatIsThere",
                   there,
                   arguments + "there.bpms.ply",
                   2,
                   "there.bpms.ply: exists already",
                   {"--overwrite"}});
    out.push_back({name + "IntoNoFolder",
                   there,
                   arguments + "none/x.ply",
                   3,
                   "none/x.ply: ",
                   {"folder does not exist"}});
    out.push_back({name + "BelowAFile", there, arguments + "grass.bpms/x.ply", 3, "grass.bpms/x.ply: ", {}});
    // Refused to everybody, also to root: nothing can be made in /proc.
    out.push_back({name + "Unwritable", there, arguments + "/proc/x.ply", 3, "/proc/x.ply: ", {}});
  }
  for (const auto& [name, arguments] : writers) {
    if (name != "Fit")
      out.push_back(
          {name + "IsAFolder", a_folder_instead("x.ply"), arguments + "x.ply", 3, "x.ply: is a folder", {}});
  }
  return out;
}
INSTANTIATE_TEST_SUITE_P(Output, Refused, ::testing::ValuesIn(rows()), name_of_case);

INSTANTIATE_TEST_SUITE_P(
    TwoOutputs, Refused,
    ::testing::ValuesIn(std::vector<Refusal>{
        Refusal{"OfOneName", as_it_is(), "simulate scene.toml -o new --csv new", 2, "new: ", {"two outputs"}},
        Refusal{"OfOneNameBuilt",
                as_it_is(),
                "build grass.bpms -o new.ply --also ./new.ply",
                2,
                "./new.ply: ",
                {"two outputs"}},
        Refusal{
            "OfTheReport", as_it_is(), "simulate scene.toml -o new.json", 2, "new.json: ", {"two outputs"}},
        Refusal{"AnImageBesideIsThere",
                written("new.png", "kept"),
                "simulate planted.toml -o new.nc",
                2,
                "new.png: exists already",
                {}},
        Refusal{"AMaterialFileBesideIsThere",
                written("new.mtl", "kept"),
                "build grass.bpms -o new.obj",
                2,
                "new.mtl: exists already",
                {}},
        Refusal{"PlantsBelowAFile",
                as_it_is(),
                "fit leaves.csv --columns plant=leaf,leaf=leaf,x=x,z=y --unit cm -o grass.bpms/x",
                3,
                "grass.bpms/x: ",
                {}},
        Refusal{"APlantIsThere",
                both(a_folder_instead("plants"), written("plants/2.bpms", "kept")),
                "fit leaves.csv --columns plant=leaf,leaf=leaf,x=x,z=y --unit cm -o plants/",
                2,
                "plants/2.bpms: exists already",
                {}}}),
    name_of_case);

TEST(Output, OverwriteReplacesTheWhole) {
  const SoundFolder folder;
  written("there.csv", std::string(100000, 'x'))(folder);
  ASSERT_EQ(run_bpms(folder, "reconstruct points.csv --rig rig.toml -o there.csv --overwrite").code, 0);
  EXPECT_THAT(read_file(folder / "there.csv"), StartsWith("plant,axis"));
  EXPECT_LT(read_file(folder / "there.csv").size(), 2000u);
}

TEST(Output, ADiskLimitIsAnErrorAndLeavesNothing) {
  for (const std::string& arguments : {simulate, reconstruct + " --report new.json", build, report}) {
    const SoundFolder folder;
    const auto before = content_of(folder);
    const Outcome run = run_bpms(folder, arguments + " --quiet", "ulimit -f 1; ");  // 512 bytes
    EXPECT_EQ(run.code, 3) << arguments << "\n" << run.error;
    EXPECT_THAT(run.error, HasSubstr("new.")) << arguments;
    EXPECT_TRUE(content_of(folder) == before) << arguments;
  }
}

TEST(Output, AFullStandardOutputIsAnError) {
  const SoundFolder folder;
  const Outcome run = run_bpms(folder, "reconstruct points.csv --rig rig.toml --quiet", "", "/dev/full");
  EXPECT_EQ(run.code, 3);
  EXPECT_THAT(run.error, StartsWith("error: standard output cannot be written"));
}

}  // namespace
}  // namespace bpms::test
