// Every row of every table: one line that says where and what, the exit code of the contract, and a folder
// that is as it was.
#include "tests/apps/refused.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/command.h"

namespace bpms::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST_P(Refused, WithOneLineAndNothingWritten) {
  const Refusal& row = GetParam();
  const SoundFolder folder;
  row.spoil(folder);
  if (HasFatalFailure()) return;
  const auto before = content_of(folder);
  const bool has_report = row.arguments.starts_with("report") || row.arguments.starts_with("check");
  const Outcome run =
      run_bpms(folder, row.arguments + (has_report ? " --quiet" : " --quiet --report new.json"));
  EXPECT_EQ(run.code, row.code) << run.error;
  EXPECT_THAT(run.error, StartsWith("error: " + row.begin));
  EXPECT_EQ(std::count(run.error.begin(), run.error.end(), '\n'), 1) << run.error;
  for (const std::string& part : row.holds) EXPECT_THAT(run.error, HasSubstr(part));
  EXPECT_TRUE(content_of(folder) == before) << "the folder is not as it was";
}

// What makes the rows mean something: unspoilt, every command does its work.
TEST(SoundFolder, ServesEveryVerb) {
  const SoundFolder folder;
  board_images(3)(folder);
  for (const std::string& arguments :
       {calibrate_corners, calibrate_images + " --overwrite", reconstruct, fit_vectors,
        fit_columns + " --overwrite", build, describe, simulate + " --overwrite", report,
        std::string("simulate planted.toml -o planted.nc"),
        std::string("check grass.bpms canopy.toml scene.toml planted.toml points.csv vectors.csv rig.toml "
                    "board.toml")}) {
    const Outcome run = run_bpms(folder, arguments);
    EXPECT_EQ(run.code, 0) << arguments << "\n" << run.error;
  }
}

}  // namespace
}  // namespace bpms::test
