// Axes as chains of frusta: neighbours share the ring at their joint, which halves the angle between them.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "plant/mesh.h"

namespace bpms {

struct AxisNode {
  Eigen::Vector3d position_m;
  double radius_m = 0;
};

struct AxisMeshOptions {
  double tolerance_m = 1e-4;                  // between polygon and circle
  bool close_base = false, close_tip = true;  // flat lids
};

// Adds the segments between nodes i and i + 1 to organs[i] (an index into mesh.organs): triangles with
// outward normals, and the areas. The polygon is as long as the circle, so that a straight axis has the area
// of its frusta.
void add_axis(const std::vector<AxisNode>& nodes, const std::vector<std::uint32_t>& organs,
              const AxisMeshOptions& options, Mesh& mesh);

// A flat blade from `base` along `along` (its length), `across` half of its width at the widest, widths as
// 4 l (1 - l): two thirds of length times width.
void add_blade(const Eigen::Vector3d& base, const Eigen::Vector3d& along, const Eigen::Vector3d& across,
               std::uint32_t organ, Mesh& mesh);
// A polygon as a fan around its first corner.
void add_polygon(const std::vector<Eigen::Vector3d>& corners, std::uint32_t organ, Mesh& mesh);

}  // namespace bpms
