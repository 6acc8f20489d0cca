// Ctrl-C: the program ends soon with 130, keeps what is done and says so, or leaves nothing; no temporary
// file stays behind.
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "core/json.h"
#include "tests/apps/sound_folder.h"
#include "tests/command.h"

namespace bpms::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// Starts the program by itself (no shell between), sends the signal after a while and waits for its end.
Outcome run_and_interrupt(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                          double seconds, int signal_number = SIGINT) {
  const TemporaryFolder heard;
  const std::string program = bpms_program(), out = heard / "out", error = heard / "error", in = folder / ".";
  std::vector<char*> words{const_cast<char*>("bpms")};
  for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    if (chdir(in.c_str()) != 0 || !freopen(out.c_str(), "w", stdout) || !freopen(error.c_str(), "w", stderr))
      _exit(99);
    execv(program.c_str(), words.data());
    _exit(98);
  }
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  kill(child, signal_number);
  int status = 0;
  waitpid(child, &status, 0);
  return {exit_code_of(status), read_file(out), read_file(error)};
}

std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  const std::size_t begin = text.find_last_of('\n', end) + 1;
  return text.substr(begin, end + 1 - begin);
}

void expect_no_temporary_files(const TemporaryFolder& folder) {
  for (const auto& [path, content] : content_of(folder)) EXPECT_THAT(path, Not(HasSubstr(".part")));
}

// Far more paths than a minute traces, so that the signal comes in the middle.
Edit endless(const std::string& file, const std::string& samples) {
  return replaced(file, samples, "samples = 50_000_000_000");
}

// The signal may come before there is anything to keep (a slow build, a busy machine): then nothing is left,
// and a later signal must find something.
void expect_partial_result(const Edit& edit, const std::string& scene, int signal_number) {
  for (double seconds = 0.5; seconds < 40; seconds *= 3) {
    const SoundFolder folder;
    edit(folder);
    const auto before = content_of(folder);
    const Outcome run = run_and_interrupt(
        folder, {"simulate", scene, "-o", "new.nc", "--csv", "new.csv", "--report", "new.json", "--quiet"},
        seconds, signal_number);
    if (run.error.empty() && run.code == 128 + signal_number) {  // it came before the program's first line
      EXPECT_TRUE(content_of(folder) == before);
      continue;
    }
    ASSERT_EQ(run.code, 130) << run.error;
    EXPECT_THAT(last_line(run.error), StartsWith("error: interrupted"));
    expect_no_temporary_files(folder);
    if (content_of(folder) == before) {
      EXPECT_THAT(run.error, HasSubstr("nothing was written"));
      continue;
    }
    EXPECT_THAT(last_line(run.error), HasSubstr("new.nc holds what was done, marked stopped_by = interrupt"));
    EXPECT_EQ(read_file(folder / "new.nc").substr(1, 3), "HDF");
    EXPECT_THAT(read_file(folder / "new.nc"), HasSubstr("interrupt"));
    EXPECT_THAT(read_file(folder / "new.csv"), StartsWith("quantity,sensor,band"));
    const Json report = Json::parse(read_file(folder / "new.json"));
    EXPECT_EQ(report["stopped_by"], "interrupt");
    EXPECT_GT(report["samples"].get<double>(), 0);
    return;
  }
  FAIL() << "never was there anything to keep";
}

TEST(Interrupt, ASimulationOfDirectionsKeepsWhatIsDone) {
  expect_partial_result(endless("scene.toml", "samples = 64"), "scene.toml", SIGINT);
}

TEST(Interrupt, ASimulationOfAnImageKeepsWhatIsDone) {
  expect_partial_result(endless("planted.toml", "samples = 32"), "planted.toml", SIGTERM);
}

// Verbs that have nothing to keep.
void expect_nothing(const Edit& edit, const std::vector<std::string>& arguments) {
  const SoundFolder folder;
  edit(folder);
  const auto before = content_of(folder);
  const Outcome run = run_and_interrupt(folder, arguments, 1.0);
  EXPECT_EQ(run.code, 130) << run.error;
  EXPECT_EQ(last_line(run.error), "error: interrupted; nothing was written");
  EXPECT_TRUE(content_of(folder) == before);
}

TEST(Interrupt, AGapFractionLeavesNothing) {
  expect_nothing(as_it_is(), {"describe", "canopy.toml", "--rays", "268435456", "--report", "new.json"});
}

TEST(Interrupt, AFitLeavesNothing) {
  std::string leaves = "leaf,x,y\n";
  for (int leaf = 0; leaf < 4000; ++leaf) {
    for (int k = 0; k < 20; ++k)
      leaves +=
          fmt::format("{},{:.3f},{:.3f}\n", leaf, 0.03 * k * k + 0.01 * (leaf * 7 % 11), k - 0.012 * k * k);
  }
  expect_nothing(written("leaves.csv", leaves), {"fit", "leaves.csv", "--columns", "leaf=leaf,x=x,z=y",
                                                 "--unit", "cm", "-o", "new.bpms", "--report", "new.json"});
}

}  // namespace
}  // namespace bpms::test
