// Rigs for round trips, and how far two of them project apart.
#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "calibrate/lenses/lens.h"
#include "calibrate/pose.h"
#include "calibrate/rig.h"
#include "core/random.h"

namespace bpms::test {

inline Camera random_camera(const std::string& name, std::size_t parameters, Philox& random) {
  Camera camera;
  camera.name = name;
  camera.width_px = 1280;
  camera.height_px = 960;
  camera.parameters = {900, 903, 641, 477, -0.21, 0.07, 0.0009, -0.0004, 0.011, 0.02, -0.01, 0.003};
  for (double& p : camera.parameters) p *= random.uniform(0.99, 1.01);
  camera.parameters.resize(parameters);
  const Eigen::Vector3d turn(random.normal(), random.normal(), random.normal());
  camera.r_cam_from_rig = rotation_from_vector(0.2 * turn);
  camera.t_cam_from_rig_m = 0.1 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  return camera;
}
inline Camera random_fisheye(const std::string& name, Philox& random) {
  Camera camera = random_camera(name, 8, random);
  camera.model = "fisheye";
  camera.parameters.resize(4);
  for (const double k : {0.02, -0.004, 0.0007, -0.0001}) camera.parameters.push_back(k * random.uniform());
  return camera;
}

// The largest distance in pixels over 1000 points before the first camera, of every camera that sees them.
inline double projected_apart(const Rig& a, const Rig& b) {
  Philox random(7);
  double out = 0;
  int compared = 0;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d x_cam(random.uniform(-0.5, 0.5), random.uniform(-0.4, 0.4), random.uniform(0.8, 3));
    const Camera& first = a.cameras.front();
    const Eigen::Vector3d in_a = first.r_cam_from_rig.transpose() * (x_cam - first.t_cam_from_rig_m);
    const Camera& first_b = b.cameras.front();
    const Eigen::Vector3d in_b = first_b.r_cam_from_rig.transpose() * (x_cam - first_b.t_cam_from_rig_m);
    for (std::size_t c = 0; c < a.cameras.size(); ++c) {
      const auto pa = project(a.cameras[c], a.cameras[c].camera_from_rig(in_a));
      const auto pb = project(b.cameras[c], b.cameras[c].camera_from_rig(in_b));
      if (pa.has_value() != pb.has_value()) return 1e9;
      if (!pa) continue;
      out = std::max(out, (*pa - *pb).norm());
      ++compared;
    }
  }
  return compared > 500 ? out : 1e9;
}

}  // namespace bpms::test
