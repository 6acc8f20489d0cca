// Measured data outside the repository: BPMS_DATA, or ../shared/data beside the checkout.
#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace bpms::test {

inline std::string data_folder() {
  if (const char* folder = std::getenv("BPMS_DATA")) return folder;
  return std::string(BPMS_SOURCE_DIR) + "/../shared/data";
}
inline bool have_data(const std::string& path) {
  return std::filesystem::exists(data_folder() + "/" + path);
}
inline bool data_required() {
  const char* required = std::getenv("BPMS_REQUIRE_DATA");
  return required != nullptr && std::string(required) == "1";
}

// A fresh folder for a test's files, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "bpms-test-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~TemporaryFolder() {
    std::error_code code;
    std::filesystem::remove_all(path_, code);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return *this / name;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace bpms::test

// In a TEST body: skips when the data are absent, fails when BPMS_REQUIRE_DATA=1.
#define BPMS_NEED_DATA(path)                                                                    \
  if (!bpms::test::have_data(path)) {                                                           \
    if (bpms::test::data_required())                                                            \
      FAIL() << "required data are absent: " << bpms::test::data_folder() << "/" << path;       \
    GTEST_SKIP() << "needs " << bpms::test::data_folder() << "/" << path << " (set BPMS_DATA)"; \
  }

// The statement throws a bpms::Error of this kind whose line contains `part`.
#define BPMS_EXPECT_ERROR(statement, error_kind, part)                                       \
  try {                                                                                      \
    statement;                                                                               \
    ADD_FAILURE() << "no error; expected one with: " << part;                                \
  } catch (const bpms::Error& error) {                                                       \
    EXPECT_EQ(static_cast<int>(error.kind()), static_cast<int>(error_kind)) << error.what(); \
    EXPECT_THAT(error.what(), ::testing::HasSubstr(part));                                   \
  }
