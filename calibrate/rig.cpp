#include "calibrate/rig.h"

#include "calibrate/lenses/lens.h"
#include "calibrate/pose.h"

namespace bpms {
namespace {

const Lens& lens_of(const Camera& camera) {
  const Lens* lens = find_lens(camera.model);
  if (lens == nullptr)
    throw Error(ErrorKind::internal, fmt::format("a camera has the unknown lens model {}", camera.model));
  return *lens;
}

LensNumbers numbers_of(const Camera& camera) {
  return {camera.parameters, camera.constants};
}

}  // namespace

int Rig::find(const std::string& camera) const {
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (cameras[i].name == camera) return static_cast<int>(i);
  }
  return -1;
}

std::vector<std::string> parameter_names(const Camera& camera) {
  std::vector<std::string> names = lens_of(camera).parameter_names(numbers_of(camera));
  for (const char* name : {"rx", "ry", "rz", "tx", "ty", "tz"}) names.emplace_back(name);
  return names;
}

std::optional<Eigen::Vector2d> project(const Camera& camera, const Eigen::Vector3d& x_cam) {
  return lens_of(camera).project(numbers_of(camera), x_cam);
}

std::optional<Projection> project_with_derivatives(const Camera& camera, const Eigen::Vector3d& x_rig) {
  const Eigen::Vector3d rotated = camera.r_cam_from_rig * x_rig, x_cam = rotated + camera.t_cam_from_rig_m;
  const auto local = lens_of(camera).project_with_derivatives(numbers_of(camera), x_cam);
  if (!local) return std::nullopt;
  Projection out;
  out.pixel = local->pixel;
  out.by_parameters = local->by_parameters;
  out.by_point = local->by_x_cam * camera.r_cam_from_rig;
  out.by_pose << -local->by_x_cam * cross_matrix(rotated), local->by_x_cam;
  return out;
}

std::optional<Eigen::Vector3d> unproject(const Camera& camera, const Eigen::Vector2d& pixel) {
  return lens_of(camera).unproject(numbers_of(camera), pixel);
}

}  // namespace bpms
