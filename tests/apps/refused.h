// Bad input as a table: what is spoilt in a sound folder, the command, and how it must end. The test that
// runs a row stands in refused_test.cpp; each table in a file of its own instantiates it.
#pragma once
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "tests/apps/sound_folder.h"

namespace bpms::test {

struct Refusal {
  std::string name;  // letters and digits
  Edit spoil;
  std::string arguments;
  int code;
  std::string begin;               // of the line, after "error: "
  std::vector<std::string> holds;  // what else stands in it
};

inline void PrintTo(const Refusal& row, std::ostream* out) {
  *out << "bpms " << row.arguments;
}

class Refused : public ::testing::TestWithParam<Refusal> {};

inline std::string name_of_case(const ::testing::TestParamInfo<Refusal>& info) {
  return info.param.name;
}

// The commands that a sound folder serves, without options on where the report goes.
inline const std::string calibrate_corners =
    "calibrate --corners corners.vnl --image-size 640x480 --target chessboard:9x6:25mm -o new.toml";
inline const std::string calibrate_images =
    "calibrate --images 'left[0-9].png' --target chessboard:9x6:20mm -o new.toml";
inline const std::string reconstruct = "reconstruct points.csv --rig rig.toml -o new.csv";
inline const std::string fit_vectors = "fit vectors.csv -o new.bpms";
inline const std::string fit_columns = "fit leaves.csv --columns leaf=leaf,x=x,z=y --unit cm -o new.bpms";
inline const std::string build = "build grass.bpms -o new.ply";
inline const std::string describe = "describe canopy.toml --rays 64";
inline const std::string simulate = "simulate scene.toml -o new.nc --csv new.csv";
inline const std::string report = "report fit.json -o new.html";

}  // namespace bpms::test
