// The ground a structure is referred to: the domain cell, or, for what stands alone, the convex hull of its
// plan view.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "scene/scene.h"

namespace bpms {

// Corners of the convex hull, counter-clockwise (monotone chain, Andrew 1979).
std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points);

class Footprint {
 public:
  explicit Footprint(const Scene& scene);
  double area_m2() const { return area_; }
  bool is_domain() const { return is_domain_; }
  // Maps (0,1)^2 onto the footprint, preserving area.
  Eigen::Vector2d point(double u, double v) const;

 private:
  std::vector<Eigen::Vector2d> corners_;
  std::vector<double> cumulative_;  // area of the fan of triangles at corner 0
  double area_ = 0;
  bool is_domain_ = false;
};

}  // namespace bpms
