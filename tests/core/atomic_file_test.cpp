#include "core/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/provenance.h"
#include "core/text.h"
#include "tests/data.h"

namespace bpms {
namespace {

using enum ErrorKind;

TEST(AtomicFile, IsThereWholeOrNotAtAll) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "out.txt";
  {
    AtomicFile file(path, false);
    file.write("half");
    EXPECT_FALSE(std::filesystem::exists(path));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder / "."));
  write_file(path, "whole", false);
  EXPECT_EQ(read_file(path), "whole");
  BPMS_EXPECT_ERROR(write_file(path, "other", false), bad_input, "exists already; give --overwrite");
  EXPECT_EQ(read_file(path), "whole");
  write_file(path, "other", true);
  EXPECT_EQ(read_file(path), "other");
  BPMS_EXPECT_ERROR(write_file(folder / "no/such/folder.txt", "x", false), missing_resource,
                    "its folder does not exist");
}

TEST(Provenance, HashesAreSha256) {
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");  // FIPS 180-2
}

}  // namespace
}  // namespace bpms
