// A rig as a model of COLMAP: an image for each camera. Read from any model: each image becomes a camera of
// the rig, with the world as the rig's frame.
#include <filesystem>

#include "calibrate/exchange/colmap_model.h"
#include "calibrate/exchange/rig_file.h"

namespace bpms {
namespace {

bool is_colmap_folder(const std::string& path, std::string_view) {
  const std::filesystem::path folder(path);
  std::error_code none;
  return std::filesystem::exists(folder / "cameras.txt", none) ||
         std::filesystem::exists(folder / "cameras.bin", none);
}

// "images/left.png" -> "left"; the whole name where two would be the same.
std::string rig_camera_name(const ColmapModel& model, const std::string& image) {
  const auto short_name = [](const std::string& name) { return std::filesystem::path(name).stem().string(); };
  int same = 0;
  for (const ColmapImage& other : model.images) same += short_name(other.name) == short_name(image);
  return same > 1 || short_name(image).empty() ? image : short_name(image);
}

RigFromFile read_colmap_rig(const std::vector<std::string>& paths, const RigReading& reading) {
  if (paths.size() > 1) bad_input({paths[1]}, "one folder of COLMAP is one rig; a second one is given");
  const ColmapModel model = read_colmap_model(paths.front());
  RigFromFile out;
  for (const ColmapImage& image : model.images) {
    Camera camera = model.cameras[static_cast<std::size_t>(image.camera)];
    camera.name = rig_camera_name(model, image.name);
    camera.r_cam_from_rig = image.cam_from_world.r;
    camera.t_cam_from_rig_m = reading.unit_m * image.cam_from_world.t_m;
    out.rig.cameras.push_back(std::move(camera));
  }
  if (model.images.empty()) {
    for (Camera camera : model.cameras) {
      camera.name = "camera" + camera.name;
      out.rig.cameras.push_back(std::move(camera));
    }
    if (model.cameras.size() > 1)
      out.notes.emplace_back("no images, so the poses of the cameras are not known");
  }
  if (out.rig.cameras.empty()) bad_input({paths.front()}, "a model without cameras");
  if (model.images.size() > 1)
    out.notes.push_back(
        fmt::format("lengths are taken as {} m a unit; COLMAP's own models have no scale", reading.unit_m));
  return out;
}

FilesOfRig write_colmap_rig(const Rig& rig, const std::string& path) {
  ColmapModel model;
  for (const Camera& camera : rig.cameras) {
    ColmapImage image;
    image.name = camera.name + ".png";
    image.camera = static_cast<int>(model.cameras.size());
    image.cam_from_world = {camera.r_cam_from_rig, camera.t_cam_from_rig_m};
    model.images.push_back(std::move(image));
    model.cameras.push_back(camera);
  }
  ColmapFiles files = colmap_text(model, path);
  FilesOfRig out;
  out.files = {{files.cameras_path, std::move(files.cameras)},
               {files.images_path, std::move(files.images)},
               {files.points_path, std::move(files.points)}};
  if (rig.covariance) out.notes.emplace_back("COLMAP's files have no covariance: it is left out");
  return out;
}

}  // namespace

const RigFormat& colmap_rig_format() {
  static const RigFormat format{"colmap", "COLMAP's text model, a folder; .bin files are read too",
                                is_colmap_folder, read_colmap_rig, write_colmap_rig};
  return format;
}

}  // namespace bpms
