#include "scene/intersect/box.h"

namespace bpms {

Box bounds(const Disc& disc) {
  // A disc of unit normal n reaches r sqrt(1 - n_i^2) along axis i.
  const Eigen::Vector3d n = disc.normal.cast<double>();
  const Eigen::Vector3d half = disc.radius_m * (1.0 - n.array().square()).max(0.0).sqrt().matrix();
  const Eigen::Vector3d c = disc.centre_m.cast<double>();
  return {c - half, c + half};
}

Box bounds(const Shape& shape) {
  Eigen::Vector3d middle, half;
  shape_box(shape, middle, half);
  return {middle - half, middle + half};
}

Box bounds(const Prototype& prototype) {
  Box out;
  for (const Shape& shape : prototype.shapes) out.include(bounds(shape));
  for (const Disc& disc : prototype.discs) out.include(bounds(disc));
  if (prototype.mesh)
    for (const Eigen::Vector3f& p : prototype.mesh->positions_m) out.include(p.cast<double>());
  return out;
}

Box bounds(const Box& prototype, const Instance& instance) {
  Box out;
  if (prototype.empty()) return out;
  for (int corner = 0; corner < 8; ++corner) {
    const double x = corner & 1 ? prototype.high.x() : prototype.low.x();
    const double y = corner & 2 ? prototype.high.y() : prototype.low.y();
    const double z = corner & 4 ? prototype.high.z() : prototype.low.z();
    out.include(instance.position_m + instance.scale * (instance.rotation * Eigen::Vector3d(x, y, z)));
  }
  return out;
}

}  // namespace bpms
