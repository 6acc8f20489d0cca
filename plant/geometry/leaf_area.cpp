// The area of a leaf by Gauss-Legendre quadrature of |dS/dl x dS/ds| over its surface. The midrib's place
// does not matter to it, only how the frame turns.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "plant/geometry/frame_rate.h"
#include "plant/geometry/gauss_legendre.h"
#include "plant/geometry/leaf_surface.h"
#include "plant/leaf_frame.h"
#include "plant/plant_mesh.h"

namespace bpms {
namespace {

// Four nodes on [-1, 1] (Abramowitz & Stegun 25.4.30).
constexpr GaussNode gauss_legendre_4[] = {{-0.8611363115940526, 0.3478548451374538},
                                          {-0.3399810435848563, 0.6521451548625461},
                                          {0.3399810435848563, 0.6521451548625461},
                                          {0.8611363115940526, 0.3478548451374538}};

class LeafArea {
 public:
  explicit LeafArea(const OrganAttributes& leaf)
      : leaf_(leaf),
        section_(leaf_section(leaf.section)),
        ends_(panel_ends(leaf)),
        form_(section_form(leaf, 0)) {}

  // Of a strip at l, over its step in l.
  double at(double l, bool exactly) {
    const double fraction = leaf_.f_width ? leaf_.f_width->value(l) : 1;
    if (!(fraction > 0)) return 0;
    width_ = leaf_.width_m * fraction;
    width_rate_ = leaf_.f_width ? leaf_.width_m * leaf_.f_width->derivative(l) : 0;
    form_.half_angle = leaf_.f_curvature ? leaf_.f_curvature->value(l) : 0;
    half_angle_rate_ = leaf_.f_curvature ? leaf_.f_curvature->derivative(l) : 0;
    rate_ = frame_rate(leaf_, l);
    // Flat and not turning but along itself: the same all across.
    const double turning = std::max(std::abs(rate_.x()), std::abs(rate_.z())) * width_ / leaf_.length_m;
    const bool flat = form_.half_angle == 0 && half_angle_rate_ == 0 && section_.has_curvature();
    if (flat && turning == 0) return leaf_.length_m * width_;
    constexpr double little = 0.3;
    if (!exactly && turning < little && std::abs(form_.half_angle) < little) return across(gauss_legendre_4);
    return across(gauss_legendre_8);
  }

 private:
  double across(std::span<const GaussNode> nodes) const {
    double sum = 0;
    for (std::size_t p = 0; p + 1 < ends_.size(); ++p) {
      const double half = (ends_[p + 1] - ends_[p]) / 2, middle = (ends_[p] + ends_[p + 1]) / 2;
      for (const GaussNode& node : nodes)
        sum += half * node.weight * element(static_cast<int>(p), middle + half * node.x);
    }
    return sum * width_ / 2;
  }
  double element(int panel, double s) const {
    const SectionPoint point = section_.point(form_, panel, s);
    const Eigen::Vector2d by_l = width_rate_ * point.at + width_ * half_angle_rate_ * point.by_half_angle;
    const Eigen::Vector3d along =
        Eigen::Vector3d(by_l.x(), by_l.y(), leaf_.length_m) +
        rate_.cross(Eigen::Vector3d(width_ * point.at.x(), width_ * point.at.y(), 0));
    return along.cross(Eigen::Vector3d(point.across.x(), point.across.y(), 0)).norm();
  }

  const OrganAttributes& leaf_;
  const LeafSection& section_;
  std::vector<double> ends_;
  SectionForm form_;
  Eigen::Vector3d rate_;
  double width_ = 0, width_rate_ = 0, half_angle_rate_ = 0;
};

double area_between(LeafArea& area, double from, double to, std::span<const GaussNode> nodes, bool exactly) {
  double sum = 0;
  const double half = (to - from) / 2;
  for (const GaussNode& node : nodes) sum += node.weight * area.at(from + half * (1 + node.x), exactly);
  return half * sum;
}

}  // namespace

double leaf_area_m2(const OrganAttributes& leaf, std::span<const double> ends) {
  LeafArea area(leaf);
  double sum = 0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    sum += area_between(area, ends[i], ends[i + 1], gauss_legendre_4, false);
  return sum;
}

double leaf_surface_area_m2(const OrganAttributes& leaf) {
  constexpr int panels = 16;  // between two kinks
  std::vector<double> ends = organ_breaks(leaf);
  ends.insert(ends.begin(), 0);
  ends.push_back(1);
  const std::vector<double> zeros = width_zeros(leaf, ends);
  ends.insert(ends.end(), zeros.begin(), zeros.end());
  std::ranges::sort(ends);
  LeafArea area(leaf);
  double sum = 0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double step = (ends[i + 1] - ends[i]) / panels;
    for (int p = 0; p < panels; ++p)
      sum += area_between(area, ends[i] + p * step, ends[i] + (p + 1) * step, gauss_legendre_8, true);
  }
  return sum;
}

}  // namespace bpms
