// Other programs that open what bpms wrote. scripts/setup installs them with the tests' packages.
#pragma once
#include <cstdlib>
#include <string>

#include "core/text.h"
#include "tests/command.h"
#include "tests/data.h"

namespace bpms::test {

// Debian's interpreter, whose modules are Debian's packages.
inline const char* const python = "/usr/bin/python3";

inline bool shell_succeeds(const std::string& command) {
  return std::system((command + " >/dev/null 2>&1").c_str()) == 0;
}
// What a command wrote on stdout; a failure of the test when it failed, with what it said.
inline std::string output_of(const std::string& command) {
  const TemporaryFolder folder;
  const int status =
      std::system((command + " >'" + folder / "out" + "' 2>'" + folder / "error" + "'").c_str());
  EXPECT_EQ(exit_code_of(status), 0) << command << "\n" << read_file(folder / "error");
  return read_file(folder / "out");
}

}  // namespace bpms::test

// In a TEST body: skips when the check fails, fails when BPMS_REQUIRE_DATA=1.
#define BPMS_NEED_TOOL(check, package)                                                    \
  if (!bpms::test::shell_succeeds(check)) {                                               \
    if (bpms::test::data_required()) FAIL() << "required program is absent: " << package; \
    GTEST_SKIP() << "needs the package " << package;                                      \
  }
#define BPMS_NEED_PYTHON(module, package) \
  BPMS_NEED_TOOL(std::string(bpms::test::python) + " -c 'import " module "'", package)
