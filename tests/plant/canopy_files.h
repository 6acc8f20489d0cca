// A folder with two small plants, and canopies read from it.
#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "core/error.h"
#include "plant/canopy.h"
#include "tests/data.h"

namespace bpms::test {

class CanopyFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder.write("a.bpms", "units cm s s { material stem a_length 10 a_radius 0.1 }");
    folder.write("b.bpms", "units cm l l { material leaf a_length 10 a_width 1 }");
  }
  // The tables in any order, `domain` and `planting` without their heads.
  Canopy read(const std::string& domain, const std::string& planting, const std::string& more = "",
              const std::string& plants = "[[plants]]\nfile = \"a.bpms\"\n") {
    return read_canopy(folder.write(
        "canopy.toml", "[domain]\n" + domain + "\n" + plants + "[planting]\n" + planting + "\n" + more));
  }
  // An ESRI grid of height(x, y), nodes `spacing` apart from (west, south).
  template <class Height>
  void write_grid(const std::string& name, int columns, int rows, double spacing, double west, double south,
                  const Height& height) {
    std::string out = fmt::format("ncols {}\nnrows {}\nxllcenter {}\nyllcenter {}\ncellsize {}\n", columns,
                                  rows, west, south, spacing);
    for (int j = rows - 1; j >= 0; --j) {
      for (int i = 0; i < columns; ++i)
        out += fmt::format("{:.9f} ", height(west + i * spacing, south + j * spacing));
      out += "\n";
    }
    folder.write(name, out);
  }
  TemporaryFolder folder;
};

}  // namespace bpms::test
