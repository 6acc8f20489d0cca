// Rigs in the files of other programs. A format is one file of this folder and one line in rig_file.cpp.
// What the formats cannot hold is refused, or said in `notes`: nothing is dropped in silence.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "calibrate/rig.h"

namespace bpms {

struct RigReading {
  std::optional<std::pair<int, int>> size_px;  // of the images, where the file does not say it
  double unit_m = 1;                           // of lengths, in formats that do not say it
};
struct RigFromFile {
  Rig rig;
  std::vector<std::string> notes;
};
struct RigFileText {
  std::string path, content;
};
struct FilesOfRig {
  std::vector<RigFileText> files;
  std::vector<std::string> notes;
};

struct RigFormat {
  std::string_view name;  // "opencv"
  std::string_view words;
  // By the path and the first 4 KiB (empty for a folder).
  bool (*recognise)(const std::string& path, std::string_view head);
  // All files together are one rig.
  RigFromFile (*read)(const std::vector<std::string>& paths, const RigReading& reading);
  // The path is a file, or a folder where it ends in '/'.
  FilesOfRig (*write)(const Rig& rig, const std::string& path);
};
const std::vector<RigFormat>& rig_formats();
const RigFormat& rig_format(const std::string& name);  // bad_input for a name that is none

// The format is told from the first path and its content; bad_input when it is none.
RigFromFile read_rig_file(const std::vector<std::string>& paths, const RigReading& reading = {});
// `format` empty: .toml is bpms, .cameramodel mrcal, .yml, .xml and .json OpenCV, .yaml Kalibr, a folder
// COLMAP.
FilesOfRig rig_files(const Rig& rig, const std::string& path, const std::string& format = {});
// The same, on disk; the folders of the files are made. Returns the notes.
std::vector<std::string> write_rig_file(const Rig& rig, const std::string& path,
                                        const std::string& format = {}, bool overwrite = false);

// The formats.
const RigFormat& bpms_rig_format();
const RigFormat& opencv_rig_format();
const RigFormat& colmap_rig_format();
const RigFormat& kalibr_rig_format();
const RigFormat& mrcal_rig_format();

// The contents of one file, for whoever has the text.
Camera parse_cameramodel(const std::string& path, const std::string& text);
Rig parse_camchain(const std::string& path, const std::string& text);

}  // namespace bpms
