#include <Eigen/Geometry>
#include <vector>

#include "calibrate/calibrate.h"
#include "calibrate/valid_region.h"

namespace bpms {
namespace {

constexpr int columns = 64, rows = 48;  // cells over the image

bool turned_over(const Camera& camera, const Eigen::Vector3d& ray) {
  Camera alone = camera;
  alone.r_cam_from_rig.setIdentity();
  alone.t_cam_from_rig_m.setZero();
  const auto at = project_with_derivatives(alone, ray);
  if (!at) return true;
  // Right-handed with the ray, as image axes x and y are with z.
  const Eigen::Vector3d a = ray.unitOrthogonal(), b = ray.cross(a);
  const Eigen::Vector2d u = at->by_point * a, v = at->by_point * b;
  return !(u.x() * v.y() - u.y() * v.x() > 0);
}

}  // namespace

// A lens that folds between two pixels of the grid sends the ray between their rays somewhere else than
// between the pixels.
std::optional<Eigen::Vector2d> pixel_without_ray(const Camera& camera,
                                                 const std::vector<Eigen::Vector2d>& region) {
  const Eigen::Vector2d cell((camera.width_px - 1.0) / columns, (camera.height_px - 1.0) / rows);
  std::vector<std::optional<Eigen::Vector3d>> above, here;
  for (int j = 0; j <= rows; ++j) {
    here.clear();
    for (int i = 0; i <= columns; ++i) {
      const Eigen::Vector2d pixel(cell.x() * i, cell.y() * j);
      here.emplace_back();
      if (!region.empty() && !inside_hull(region, pixel)) continue;
      here.back() = unproject(camera, pixel);
      if (!here.back() || turned_over(camera, *here.back())) return pixel;
      const auto at = static_cast<std::size_t>(i);
      if (i == 0 || j == 0 || !here[at - 1] || !above[at] || !above[at - 1]) continue;
      const Eigen::Vector3d middle = *here[at] + *here[at - 1] + *above[at] + *above[at - 1];
      const auto back = project(camera, middle);
      const Eigen::Vector2d expected = pixel - 0.5 * cell;
      if (!back || !((*back - expected).cwiseQuotient(cell).cwiseAbs().maxCoeff() < 1)) return expected;
    }
    above.swap(here);
  }
  return std::nullopt;
}

}  // namespace bpms
