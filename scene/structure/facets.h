// The surface of a prototype, one flat piece after the other: triangles of its mesh, discs, and shapes cut
// into triangles of the same area. What counts as a leaf: discs, and organs of kind "leaf".
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>

#include "scene/scene.h"

namespace bpms {

struct Facet {
  Eigen::Vector3d area_vector;             // normal x area
  std::array<Eigen::Vector3d, 3> corners;  // of a disc: the first is its centre
  float disc_radius_m = 0;                 // 0: a triangle
  std::uint32_t material = 0;
  std::uint32_t organ = no_organ;  // of the mesh
  bool leaf = false;

  Eigen::Vector3d middle() const {
    return disc_radius_m > 0 ? corners[0] : ((corners[0] + corners[1] + corners[2]) / 3).eval();
  }
};

void visit_facets(const Prototype& prototype, const std::function<void(const Facet&)>& visit);
// How many it has.
std::uint64_t facet_count(const Prototype& prototype);

// A shape's surface as triangles; the area of each part (side, ends) is the exact one. Of a closed cylinder
// the ends that are asked for.
struct ShapeEnds {
  bool first = true, second = true;
};
void visit_shape_facets(const Shape& shape, const std::function<void(const Facet&)>& visit,
                        ShapeEnds ends = {});

}  // namespace bpms
