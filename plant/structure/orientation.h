// How the facets of a surface are turned: areas by the inclination and azimuth of their normals, and what
// follows from these: leaf angle distribution, G.
//
// Inclination = zenith angle of the normal, which is taken to look up (0..90 degrees); azimuth = that of the
// upward normal, counter-clockwise from x (a vertical facet has two; it counts with the one of its own
// normal). G(theta) = sum A |n . Omega| / sum A, averaged over all azimuths of Omega, or for one of them
// (Ross 1981).
//
// Sums are kept over 1800 bins of inclination with their mean angles, from which G(theta) is exact to 1e-6,
// and over cells of 1 by 2 degrees with their summed area vectors, from which G(theta, phi) is exact but for
// the cells that are seen edge on (1e-4). So a canopy of any size takes the same memory.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "plant/mesh.h"

namespace bpms {

struct AngleBin {
  double from_deg = 0, to_deg = 0;
  double probability = 0;      // sums to 1 over the bins
  double density_per_deg = 0;  // probability / width: integrates to 1
};

class FacetOrientation {
 public:
  FacetOrientation();

  void add(const Eigen::Vector3d& area_vector);  // normal x area
  void add(const FacetOrientation& other, double factor = 1);
  // Turned about z, or in space.
  void add(const FacetOrientation& other, double factor, double about_z);
  void add(const FacetOrientation& other, double factor, const Eigen::Matrix3d& rotation);

  double area() const { return area_; }
  bool empty() const { return !(area_ > 0); }
  double mean_inclination() const { return angle_sum_ / area_; }
  double sd_inclination() const;
  double mean_cos2() const { return cos2_sum_ / area_; }
  // Widths that divide 90 (and are multiples of 0.05) and 360 (multiples of 2).
  std::vector<AngleBin> inclination_bins(double width_deg = 5) const;
  std::vector<AngleBin> azimuth_bins(double width_deg = 10) const;

  double g(double zenith) const;
  double g(double zenith, double azimuth) const;

  // Groups of facets that are turned nearly alike: summed area, and the summed area vector.
  struct Cell {
    double area = 0;
    Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  };
  const std::vector<Cell>& cells() const { return cells_; }  // many of them empty
  // The same by inclination alone: `count` groups with their mean inclination.
  struct Band {
    double area = 0, inclination = 0;
  };
  std::vector<Band> bands(std::size_t count = 180) const;

 private:
  void add_inclination(double angle, double area);
  void add_cell(const Eigen::Vector3d& up, const Cell& cell);

  std::vector<Cell> cells_;
  std::vector<double> weight_, weighted_angle_;  // by bins of inclination
  double area_ = 0, angle_sum_ = 0, angle2_sum_ = 0, cos2_sum_ = 0;
};

// The facets of a mesh whose organs' kind is "leaf".
FacetOrientation leaf_orientation(const Mesh& mesh);
Eigen::Vector3d triangle_area_vector(const Mesh& mesh, std::size_t triangle);

}  // namespace bpms
