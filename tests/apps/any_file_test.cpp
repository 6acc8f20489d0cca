// What can be wrong with any file, for the reader of every kind.
#include <fmt/format.h>

#include "tests/apps/refused.h"

namespace bpms::test {
namespace {

struct Reader {
  std::string name, file, arguments;
};

std::vector<Refusal> rows() {
  const std::vector<Reader> readers{
      {"Corners", "corners.vnl", calibrate_corners},
      {"Board", "board.toml",
       "calibrate --corners corners.vnl --image-size 640x480 --target board.toml -o new"},
      {"Points", "points.csv", reconstruct},
      {"Rig", "rig.toml", reconstruct},
      {"Vectors", "vectors.csv", fit_vectors},
      {"Columns", "leaves.csv", fit_columns},
      {"Plant", "grass.bpms", build},
      {"Canopy", "canopy.toml", describe},
      {"PlantOfCanopy", "grass.bpms", describe},
      {"CanopyOfScene", "canopy.toml", "simulate planted.toml -o new.nc"},
      {"Scene", "scene.toml", simulate},
      {"SceneToDescribe", "scene.toml", "describe scene.toml"},
      {"Spectrum", "soil.csv", simulate},
      {"Discs", "crown.def", simulate},
      {"Positions", "places.def", simulate},
      {"Report", "fit.json", report},
      {"Checked", "points.csv", "check points.csv"},
  };
  std::vector<Refusal> out;
  for (const auto& [name, file, arguments] : readers) {
    out.push_back({name + "Absent", removed(file), arguments, 3, file + ": no such file", {}});
    out.push_back({name + "IsAFolder", a_folder_instead(file), arguments, 3, file + ": is a folder", {}});
    out.push_back({name + "Empty", written(file, ""), arguments, 2, file + ": the file is empty", {}});
    out.push_back(
        {name + "Blank", written(file, "\n \t\r\n"), arguments, 2, file + ": the file is empty", {}});
    out.push_back({name + "Binary",
                   written(file, std::string("\x7f"
                                             "ELF\2\n\0\1\xff",
                                             9)),
                   arguments,
                   2,
                   file + ":2: binary content",
                   {}});
    // Bytes without a NUL pass for text, and must be refused by what is expected of the text.
    out.push_back({name + "Noise",
                   written(file, "\xff\xd8\xff\xe0\x10JFIF \x01\x80\x9d\n\xfe\xed\n"),
                   arguments,
                   2,
                   file + ":",
                   {}});
    out.push_back({name + "CutGzip",
                   written(file, std::string("\x1f\x8b\x08\0\0\0\0\0\0\3\xcb", 11)),
                   arguments,
                   2,
                   file + ": ends in the middle of its compressed data",
                   {}});
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(AnyFile, Refused, ::testing::ValuesIn(rows()), name_of_case);

}  // namespace
}  // namespace bpms::test
