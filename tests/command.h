// The program as users run it: a command line in a folder, what it printed and how it ended.
#pragma once
#include <fmt/format.h>
#include <sys/wait.h>

#include <cstdlib>

#include "core/text.h"
#include "tests/data.h"

namespace bpms::test {

struct Outcome {
  int code = 0;  // the exit code; 128 + the signal's number when one ended it
  std::string out, error;
};

inline int exit_code_of(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

inline std::string bpms_program() {
  return std::string(BPMS_BINARY_DIR) + "/bpms";
}

// `before`: what the shell does first, such as "ulimit -f 1; ". `out`: a device in place of what is kept of
// the standard output.
inline Outcome run_bpms(const TemporaryFolder& folder, const std::string& arguments,
                        const std::string& before = {}, const std::string& out = {}) {
  const TemporaryFolder heard;  // not in the folder of the run, which tests list
  const std::string command =
      fmt::format("cd '{}' && {}exec '{}' {} >'{}' 2>'{}'", folder / ".", before, bpms_program(), arguments,
                  out.empty() ? heard / "out" : out, heard / "error");
  const int status = std::system(command.c_str());
  return {exit_code_of(status), out.empty() ? read_file(heard / "out") : "", read_file(heard / "error")};
}

}  // namespace bpms::test
