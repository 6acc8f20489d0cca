// The forward model of a leaf as a fit needs it: positions of midrib and edges with their derivatives.
//   M(l)  = base + length Rz(direction) integral_0^l z,   z = (cos a sin i, -sin a, cos a cos i)
//   E+-(l) = M(l) +- w(l)/2 y(l),   y = Rz(direction) Ry(i) Rx(a) Rz(t) e_y
// with inclination i, azimuth a, twist t and width w linear in their coefficients (fit/function_basis.h). E+
// is the left edge for one who looks from the base to the tip with the upper face up. Parameters: length,
// [direction], base (some of x y z), then the coefficients of i, a, t, w.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "fit/function_basis.h"

namespace bpms {

struct LeafModelShape {
  FunctionBasis inclination, azimuth, twist, width;
  bool direction_free = true;
  double direction = 0;                            // rotation about the vertical, where it is not free
  std::vector<int> base_axes;                      // coordinates of the base that are free
  Eigen::Vector3d base = Eigen::Vector3d::Zero();  // the others
};

enum class LeafCurve { midrib, edge_left, edge_right };

class LeafModel {
 public:
  explicit LeafModel(LeafModelShape shape);
  const LeafModelShape& shape() const { return shape_; }

  int parameters() const { return at_width_ + shape_.width.size(); }
  static constexpr int at_length() { return 0; }
  int at_direction() const { return 1; }  // only where it is free
  int at_base() const { return shape_.direction_free ? 2 : 1; }
  int at_inclination() const { return at_base() + static_cast<int>(shape_.base_axes.size()); }
  int at_azimuth() const { return at_inclination() + shape_.inclination.size(); }
  int at_twist() const { return at_azimuth() + shape_.azimuth.size(); }
  int at_width() const { return at_width_; }

  // Sets the parameters: the integrals up to the ends of the panels are made here.
  void set(const Eigen::VectorXd& parameters, bool with_derivatives);
  struct Point {
    Eigen::Vector3d x;
    Eigen::Vector3d tangent;    // dx/dl
    Eigen::Matrix3Xd jacobian;  // dx/dparameters, where asked for
  };
  void point(LeafCurve curve, double l, bool with_derivatives, Point& out) const;
  Eigen::Matrix3d frame(double l) const;  // columns x y z before the twist

 private:
  struct Angles {
    double si, ci, sa, ca;
  };
  // Of z, then of dz/d(coefficients of i, a); on the stack, for it is copied in the innermost loop.
  using Integral = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 1 + 2 * most_coefficients>;
  Angles angles(const double* phi_i, const double* phi_a) const;
  void add_node(const double* phi_i, const double* phi_a, double weight, bool with_derivatives,
                Integral& sum) const;
  // E - M in the frame before Rz(direction), for side +1 or -1, and its derivatives by i, a, t, w.
  Eigen::Vector3d edge_offset(double l, double side, Eigen::Matrix<double, 3, 4>* derivatives) const;

  LeafModelShape shape_;
  int at_width_ = 0;
  std::vector<double> ends_;           // of the panels
  Eigen::MatrixXd table_i_, table_a_;  // basis at the panels' nodes, one column a node
  Eigen::VectorXd parameters_;
  std::vector<Integral> at_end_;  // the integral from 0 to ends_[k]
};

}  // namespace bpms
