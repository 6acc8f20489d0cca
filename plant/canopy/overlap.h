// Overlap between plants: leaf area on triangles that cross triangles of other plants (of any organ), in
// a periodic canopy also of their images. Lewis 1999, section 2.1.4, names it as what clones cannot avoid. By
// triangles against triangles between neighbours: plants in the cells of a uniform grid, then spheres around
// organs and around runs of triangles. A triangle that crosses counts whole, so the finer the mesh, the
// nearer to the strip that is really inside others: about its length times the size of the triangles.
#pragma once
#include <memory>
#include <vector>

#include "plant/canopy.h"

namespace bpms {

class PlantCrossings {
 public:
  // The plants of the canopy have their meshes. Placements are copied.
  explicit PlantCrossings(const Canopy& canopy);
  ~PlantCrossings();
  PlantCrossings(const PlantCrossings&) = delete;
  PlantCrossings& operator=(const PlantCrossings&) = delete;

  struct Area {
    double own_m2 = 0;     // leaf area of the plant that crosses others
    double others_m2 = 0;  // leaf area of the others that crosses it
    double sum() const { return own_m2 + others_m2; }
  };
  Area crossing(std::size_t i) const;
  // As it would be if plant i stood there. Re-entrant.
  Area crossing(std::size_t i, const Placement& there) const;
  void move(std::size_t i, const Placement& there);

  // For each plant its own leaf area that crosses others; on all threads.
  std::vector<double> own_m2() const;
  double leaf_area_m2() const;
  double largest_radius_m() const;  // of the sphere around a plant

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Fills in the meshes of the plants that lack one, on all threads.
void make_canopy_meshes(Canopy& canopy);

// The share of the leaf area on triangles that cross other plants. The plants have their meshes.
double overlap_fraction(const Canopy& canopy);

}  // namespace bpms
