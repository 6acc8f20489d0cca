#include "plant/mesh_mass.h"

#include <Eigen/Geometry>

namespace bpms {

std::vector<OrganMass> triangle_masses(const Mesh& mesh) {
  std::vector<OrganMass> out(mesh.organs.size());
  std::vector<Eigen::Vector3d> of_area(out.size(), Eigen::Vector3d::Zero()), of_volume = of_area;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::size_t organ = mesh.organ_of_triangle.empty() ? 0 : mesh.organ_of_triangle[t];
    const auto corner = [&](std::size_t k) {
      return Eigen::Vector3d(mesh.positions_m[mesh.triangles[t][k]].cast<double>());
    };
    const Eigen::Vector3d a = corner(0), b = corner(1), c = corner(2), sum = a + b + c;
    const double area = (b - a).cross(c - a).norm() / 2, volume = a.dot(b.cross(c)) / 6;
    out[organ].area_m2 += area;
    out[organ].volume_m3 += volume;
    of_area[organ] += area * sum / 3;
    of_volume[organ] += volume * sum / 4;  // the tetrahedron with the origin
  }
  for (std::size_t k = 0; k < out.size(); ++k) {
    OrganMass& organ = out[k];
    const bool sheet = mesh.organs[k].kind == "leaf";
    if (sheet) organ.volume_m3 = 0;
    if (sheet && organ.area_m2 > 0) organ.centroid_m = of_area[k] / organ.area_m2;
    if (!sheet && organ.volume_m3 > 0) organ.centroid_m = of_volume[k] / organ.volume_m3;
  }
  return out;
}

OrganMass plant_mass(const Mesh& mesh) {
  OrganMass out;
  Eigen::Vector3d of_volume = Eigen::Vector3d::Zero(), of_sheets = of_volume;
  double sheets = 0;
  for (const Mesh::Organ& organ : mesh.organs) {
    out.area_m2 += organ.area_m2;
    out.volume_m3 += organ.volume_m3;
    of_volume += organ.volume_m3 * organ.centroid_m;
    if (organ.volume_m3 > 0) continue;
    sheets += organ.area_m2;
    of_sheets += organ.area_m2 * organ.centroid_m;
  }
  if (out.volume_m3 > 0)
    out.centroid_m = of_volume / out.volume_m3;
  else if (sheets > 0)
    out.centroid_m = of_sheets / sheets;
  return out;
}

}  // namespace bpms
