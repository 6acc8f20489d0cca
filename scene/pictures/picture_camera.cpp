#include "scene/pictures/picture_camera.h"

#include <algorithm>
#include <cmath>

#include "core/nearest.h"
#include "core/units.h"
#include "scene/intersect/box.h"

namespace bpms {
namespace {

const PictureView named_views[] = {{"front", 180, 0}, {"back", 0, 0},   {"side", 90, 0},
                                   {"left", 270, 0},  {"top", 180, 90}, {"oblique", 215, 30}};

std::vector<Eigen::Vector3f> corners_of(const Prototype& prototype) {
  const Box box = bounds(prototype);
  std::vector<Eigen::Vector3f> out;
  if (box.empty()) return out;
  for (int k = 0; k < 8; ++k)
    out.emplace_back(Eigen::Vector3d(k & 1 ? box.high.x() : box.low.x(), k & 2 ? box.high.y() : box.low.y(),
                                     k & 4 ? box.high.z() : box.low.z())
                         .cast<float>());
  return out;
}

// Points that enclose the scene: those of its meshes, or, where these would be too many, corners of boxes.
template <class Take>
void for_each_frame_point(const Scene& scene, const Take& take) {
  constexpr std::size_t most_points = 4'000'000;
  std::size_t points = 0;
  for (const Instance& instance : scene.instances) {
    const Prototype& prototype = scene.prototypes[instance.prototype];
    points += prototype.mesh ? prototype.mesh->positions_m.size() : 0;
  }
  std::vector<std::vector<Eigen::Vector3f>> corners;
  for (const Prototype& prototype : scene.prototypes) corners.push_back(corners_of(prototype));
  for (const Instance& instance : scene.instances) {
    const Prototype& prototype = scene.prototypes[instance.prototype];
    const bool by_mesh =
        prototype.mesh && prototype.discs.empty() && prototype.shapes.empty() && points <= most_points;
    const std::vector<Eigen::Vector3f>& own =
        by_mesh ? prototype.mesh->positions_m : corners[instance.prototype];
    for (const Eigen::Vector3f& p : own)
      take(instance.position_m + instance.rotation * (instance.scale * p.cast<double>()));
  }
}

// The distance from the middle at which an eye sees all of the scene, and nothing touches the eye.
double eye_distance(const Scene& scene, const PictureFrame& frame, double tan_x, double tan_y) {
  const Eigen::Vector3d middle = 0.5 * (frame.low + frame.high);
  double distance = 0;
  for_each_frame_point(scene, [&](const Eigen::Vector3d& p) {
    const double x = p.dot(frame.right) - middle.x(), y = p.dot(frame.up) - middle.y();
    const double z = p.dot(frame.back) - middle.z();
    distance = std::max({distance, z + std::abs(x) / tan_x, z + std::abs(y) / tan_y, 1.01 * z});
  });
  return distance;
}

}  // namespace

std::vector<std::string> view_names() {
  std::vector<std::string> out;
  for (const PictureView& view : named_views) out.push_back(view.name);
  return out;
}

PictureView named_view(const std::string& name) {
  for (const PictureView& view : named_views)
    if (view.name == name) return view;
  bad_input({"--views"}, "unknown view {}{}", in_quotes(name), did_you_mean(name, view_names()));
}

PictureFrame frame_of(const Scene& scene, const PictureView& view) {
  PictureFrame out;
  const double azimuth = radians(view.azimuth_deg), elevation = radians(view.elevation_deg);
  out.back = {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
              std::sin(elevation)};
  out.right = {-std::cos(azimuth), std::sin(azimuth), 0};
  out.up = out.back.cross(out.right);
  out.low = Eigen::Vector3d::Constant(1e300), out.high = -out.low;
  for_each_frame_point(scene, [&out](const Eigen::Vector3d& p) {
    const Eigen::Vector3d seen(p.dot(out.right), p.dot(out.up), p.dot(out.back));
    out.low = out.low.cwiseMin(seen), out.high = out.high.cwiseMax(seen);
  });
  return out;
}

PictureCamera fit_camera(const Scene& scene, const PictureView& view, double width, double height,
                         double fov_deg, double metres_per_pixel) {
  PictureCamera out{frame_of(scene, view), width, height, metres_per_pixel, 0};
  const Eigen::Vector3d size = out.frame.high - out.frame.low;
  if (fov_deg > 0) {
    const double tan_half = std::tan(radians(0.5 * fov_deg)), larger = std::max(width, height);
    out.eye_distance_m =
        eye_distance(scene, out.frame, tan_half * width / larger, tan_half * height / larger);
    out.metres_per_pixel = 2 * out.eye_distance_m * tan_half / larger;
  } else if (!(metres_per_pixel > 0)) {
    out.metres_per_pixel = std::max(size.x() / width, size.y() / height);
  }
  return out;
}

Ray PictureCamera::ray(double x, double y) const {
  const Eigen::Vector3d middle = 0.5 * (frame.low + frame.high);
  const double u = (x - 0.5 * width) * metres_per_pixel, v = (0.5 * height - y) * metres_per_pixel;
  Ray out;
  const double depth = frame.high.z() - frame.low.z();
  // An orthographic ray starts a little before all that there is.
  const double start =
      eye_distance_m > 0 ? eye_distance_m : 0.5 * depth + 0.01 * (depth + width * metres_per_pixel);
  const Eigen::Vector3d at = frame.right * middle.x() + frame.up * middle.y() + frame.back * middle.z();
  const Eigen::Vector3d target = at + u * frame.right + v * frame.up;
  const Eigen::Vector3d origin = (eye_distance_m > 0 ? at : target) + start * frame.back;
  out.origin = origin.cast<float>();
  out.direction = (eye_distance_m > 0 ? (target - origin).normalized() : (-frame.back).eval()).cast<float>();
  return out;
}

}  // namespace bpms
