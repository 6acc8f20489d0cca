#include "plant/structure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace bpms {
namespace {

constexpr double bin_deg = 5;
constexpr std::size_t bins = 18;
// G is summed over a finer histogram of the angles than is reported, at each bin's mean angle: what 0.05
// degrees of spread within a bin do to it is below 1e-6.
constexpr std::size_t fine_bins = 1800;

struct LeafAngles {
  std::vector<double> coarse = std::vector<double>(bins);
  std::vector<double> fine = std::vector<double>(fine_bins), fine_angle = std::vector<double>(fine_bins);
  double area = 0, angle_sum = 0, cos2_sum = 0;

  void add(double angle, double weight) {
    const double fraction = std::clamp(angle / (pi / 2), 0.0, 1.0);
    const auto bin = [&](std::size_t count) {
      return std::min(count - 1, static_cast<std::size_t>(fraction * static_cast<double>(count)));
    };
    coarse[bin(bins)] += weight;
    fine[bin(fine_bins)] += weight;
    fine_angle[bin(fine_bins)] += weight * angle;
    area += weight;
    angle_sum += weight * angle;
    cos2_sum += weight * std::pow(std::cos(angle), 2);
  }
  double g(double zenith) const {
    double sum = 0;
    for (std::size_t i = 0; i < fine_bins; ++i) {
      if (fine[i] > 0) sum += fine[i] * mean_projection(fine_angle[i] / fine[i], zenith);
    }
    return sum / area;
  }
};

}  // namespace

double mean_projection(double leaf_angle, double zenith) {
  const double a = std::cos(zenith) * std::cos(leaf_angle);
  const double b = std::sin(zenith) * std::sin(leaf_angle);
  if (b <= std::abs(a)) return std::abs(a);  // the facet shows one side whatever the azimuth
  const double psi = std::acos(std::clamp(-a / b, -1.0, 1.0));
  return (a * (2 * psi - pi) + 2 * b * std::sin(psi)) / pi;
}

std::vector<double> usual_zenith_angles_deg() {
  std::vector<double> out{57.5};
  for (int zenith = 0; zenith <= 90; zenith += 5) out.push_back(zenith);
  std::ranges::sort(out);
  return out;
}

FacetStructure facet_structure(const std::vector<WeightedMesh>& meshes,
                               const std::vector<double>& zenith_deg) {
  FacetStructure out;
  LeafAngles angles;
  for (const WeightedMesh& weighted : meshes) {
    const Mesh& mesh = *weighted.mesh;
    for (const Eigen::Vector3f& p : mesh.positions_m)
      out.height_m = std::max(out.height_m, weighted.height_factor * static_cast<double>(p.z()));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Mesh::Organ& organ = mesh.organs[mesh.organ_of_triangle[t]];
      const double area = weighted.area_factor * triangle_area_m2(mesh, t);
      if (organ.kind != "leaf") {
        out.other_area_m2[organ.material] += area;
        continue;
      }
      out.leaf_area_m2[organ.material] += area;
      out.total_leaf_area_m2 += area;
      const auto& [a, b, c] = mesh.triangles[t];
      const Eigen::Vector3d p = mesh.positions_m[a].cast<double>();
      const Eigen::Vector3d normal =
          (mesh.positions_m[b].cast<double>() - p).cross(mesh.positions_m[c].cast<double>() - p);
      if (area > 0) angles.add(std::atan2(normal.head<2>().norm(), std::abs(normal.z())), area);
    }
  }
  if (angles.area <= 0) return out;
  for (std::size_t i = 0; i < bins; ++i) {
    const double from = bin_deg * static_cast<double>(i);
    const double probability = angles.coarse[i] / angles.area;
    out.leaf_angle.push_back({from, from + bin_deg, probability, probability / bin_deg});
  }
  out.mean_leaf_angle_deg = degrees(angles.angle_sum / angles.area);
  out.mean_cos2 = angles.cos2_sum / angles.area;
  for (const double zenith : zenith_deg) out.g_function.push_back({zenith, angles.g(radians(zenith))});
  return out;
}

}  // namespace bpms
