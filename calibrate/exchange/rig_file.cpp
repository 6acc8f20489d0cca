#include "calibrate/exchange/rig_file.h"

#include <filesystem>
#include <set>

#include "core/atomic_file.h"
#include "core/nearest.h"
#include "core/text.h"

namespace bpms {
namespace {

std::string names_of_formats() {
  std::string out;
  for (const RigFormat& format : rig_formats()) out += (out.empty() ? "" : ", ") + std::string(format.name);
  return out;
}

const RigFormat& format_of_output(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  std::error_code none;
  if (path.ends_with('/') || std::filesystem::is_directory(path, none)) return rig_format("colmap");
  if (ending == ".toml") return rig_format("bpms");
  if (ending == ".cameramodel") return rig_format("mrcal");
  if (ending == ".yml" || ending == ".xml" || ending == ".json") return rig_format("opencv");
  if (ending == ".yaml") return rig_format("kalibr");
  bad_input({path}, "the name does not say the format; name it: {}", names_of_formats());
}

void require_known_order(const std::string& path, const Rig& rig) {
  if (!rig.covariance) return;
  std::set<std::string> known;
  for (const Camera& camera : rig.cameras)
    for (const std::string& name : parameter_names(camera)) known.insert(camera.name + "." + name);
  for (const std::string& name : rig.covariance->order)
    if (known.erase(name) == 0)
      bad_input({path}, "the covariance names {}, which is no parameter of the rig, or named twice",
                in_quotes(name));
}

}  // namespace

const std::vector<RigFormat>& rig_formats() {
  static const std::vector<RigFormat> formats{bpms_rig_format(), opencv_rig_format(), colmap_rig_format(),
                                              kalibr_rig_format(), mrcal_rig_format()};
  return formats;
}

const RigFormat& rig_format(const std::string& name) {
  std::vector<std::string> names;
  for (const RigFormat& format : rig_formats()) {
    if (format.name == name) return format;
    names.emplace_back(format.name);
  }
  bad_input({}, "no format of camera files {}; expected {}{}", in_quotes(name), names_of_formats(),
            did_you_mean(name, names));
}

RigFromFile read_rig_file(const std::vector<std::string>& paths, const RigReading& reading) {
  if (paths.empty()) bad_input({}, "no camera file is given");
  const std::string& path = paths.front();
  std::error_code none;
  constexpr std::size_t head_bytes = 4096;
  const std::string head =
      std::filesystem::is_directory(path, none) ? "" : read_file(path).substr(0, head_bytes);
  for (const RigFormat& format : rig_formats()) {
    if (!format.recognise(path, head)) continue;
    RigFromFile out = format.read(paths, reading);
    require_known_order(path, out.rig);
    return out;
  }
  bad_input({path}, "not recognised as a camera file; formats are {}", names_of_formats());
}

FilesOfRig rig_files(const Rig& rig, const std::string& path, const std::string& format) {
  if (rig.cameras.empty()) bad_input({path}, "a rig without cameras has no file");
  std::error_code none;
  const std::string to =
      std::filesystem::is_directory(path, none) && !path.ends_with('/') ? path + "/" : path;
  const RigFormat& how = format.empty() ? format_of_output(to) : rig_format(format);
  return how.write(rig, to);
}

std::vector<std::string> write_rig_file(const Rig& rig, const std::string& path, const std::string& format,
                                        bool overwrite) {
  const FilesOfRig out = rig_files(rig, path, format);
  for (const RigFileText& file : out.files) {
    const auto folder = std::filesystem::path(file.path).parent_path();
    std::error_code code;
    if (path.ends_with('/') && !folder.empty()) std::filesystem::create_directories(folder, code);
    require_writable(file.path, overwrite);
  }
  for (const RigFileText& file : out.files) write_file(file.path, file.content, overwrite);
  return out.notes;
}

}  // namespace bpms
