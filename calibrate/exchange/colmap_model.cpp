#include "calibrate/exchange/colmap_model.h"

#include <filesystem>

#include "core/atomic_file.h"
#include "core/text.h"

namespace bpms {

int ColmapModel::find_image(const std::string& name) const {
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (images[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

ColmapModel read_colmap_model(const std::string& folder) {
  const std::filesystem::path in(folder);
  if (!std::filesystem::is_directory(in))
    fail(ErrorKind::missing_resource, {folder},
         "no such folder; expected one with cameras, images, points3D");
  const bool binary = std::filesystem::exists(in / "cameras.bin");
  const std::string ending = binary ? ".bin" : ".txt";
  ColmapFiles files;
  files.cameras_path = (in / ("cameras" + ending)).string();
  files.images_path = (in / ("images" + ending)).string();
  files.points_path = (in / ("points3D" + ending)).string();
  files.cameras = read_file(files.cameras_path);
  files.images = read_file(files.images_path);
  files.points = read_file(files.points_path);
  return binary ? parse_colmap_binary(files) : parse_colmap_text(files);
}

void write_colmap_model(const ColmapModel& model, const std::string& folder, bool overwrite) {
  const ColmapFiles files = colmap_text(model, folder);
  for (const std::string* path : {&files.cameras_path, &files.images_path, &files.points_path})
    if (std::filesystem::exists(folder)) require_writable(*path, overwrite);
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (code) fail(ErrorKind::missing_resource, {folder}, "the folder cannot be made: {}", code.message());
  write_file(files.cameras_path, files.cameras, overwrite);
  write_file(files.images_path, files.images, overwrite);
  write_file(files.points_path, files.points, overwrite);
}

}  // namespace bpms
