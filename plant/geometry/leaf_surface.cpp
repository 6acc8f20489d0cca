#include "plant/geometry/leaf_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "plant/geometry/frame_rate.h"
#include "plant/leaf_frame.h"

namespace bpms {
namespace {

// In the row's frame.
Eigen::Vector3d own_derivative_m(const LeafRow& row, const SectionPoint& point) {
  const Eigen::Vector2d section = row.width_m * point.at;
  const Eigen::Vector2d by_l =
      row.width_rate_m * point.at + row.width_m * row.half_angle_rate * point.by_half_angle;
  return Eigen::Vector3d(by_l.x(), by_l.y(), row.length_m) +
         row.rate.cross(Eigen::Vector3d(section.x(), section.y(), 0));
}

Eigen::Vector3d in_space(const Eigen::Vector2d& v) {
  return {v.x(), v.y(), 0};
}

}  // namespace

LeafRow leaf_row(const OrganAttributes& leaf, const LeafSection& section, double l,
                 const Eigen::Vector3d& midrib_m) {
  LeafRow row;
  row.l = l;
  row.midrib_m = midrib_m;
  const MovingFrame moving = moving_frame(leaf, l);
  row.frame = moving.frame;
  row.rate = moving.rate;
  row.length_m = leaf.length_m;
  const double fraction = leaf.f_width ? leaf.f_width->value(l) : 1.0;
  row.width_m = leaf.width_m * std::max(0.0, fraction);
  row.width_rate_m = fraction > 0 && leaf.f_width ? leaf.width_m * leaf.f_width->derivative(l) : 0.0;
  row.form = section_form(leaf, 0);
  if (leaf.f_curvature) {
    row.form.half_angle = leaf.f_curvature->value(l);
    row.half_angle_rate = leaf.f_curvature->derivative(l);
  }
  row.section = &section;
  return row;
}

std::vector<LeafRow> leaf_rows(const OrganAttributes& leaf, const std::vector<double>& l) {
  std::vector<LeafRow> out;
  out.reserve(l.size());
  const LeafSection& section = leaf_section(leaf.section);
  Eigen::Vector3d midrib_m = Eigen::Vector3d::Zero();
  double from = 0;
  const auto advance = [&](double to) {
    if (to == from) return;
    midrib_m += leaf.length_m * midrib_step(leaf, from, to);
    from = to;
  };
  const std::vector<double> breaks = organ_breaks(leaf);
  auto next_break = breaks.begin();
  for (const double to : l) {
    for (; next_break != breaks.end() && *next_break < to; ++next_break)
      if (*next_break > from) advance(*next_break);
    advance(to);
    out.push_back(leaf_row(leaf, section, to, midrib_m));
  }
  return out;
}

int panel_at(const LeafRow& row, double s) {
  const std::vector<double> folds = row.section->folds(row.form);
  return static_cast<int>(std::upper_bound(folds.begin(), folds.end(), s) - folds.begin());
}

std::vector<double> panel_ends(const OrganAttributes& leaf) {
  std::vector<double> out = leaf_section(leaf.section).folds(section_form(leaf, 0));
  out.insert(out.begin(), -1);
  out.push_back(1);
  return out;
}

Eigen::Vector3d leaf_section_m(const LeafRow& row, double s) {
  return row.width_m * in_space(row.section->point(row.form, panel_at(row, s), s).at);
}

Eigen::Vector3d leaf_point_m(const LeafRow& row, int panel, double s) {
  return row.midrib_m + row.frame * (row.width_m * in_space(row.section->point(row.form, panel, s).at));
}
Eigen::Vector3d leaf_point_m(const LeafRow& row, double s) {
  return leaf_point_m(row, panel_at(row, s), s);
}

Eigen::Vector3d leaf_derivative_m(const LeafRow& row, int panel, double s) {
  return row.frame * own_derivative_m(row, row.section->point(row.form, panel, s));
}

Eigen::Vector3d leaf_across(const LeafRow& row, int panel, double s) {
  return row.frame * in_space(row.section->point(row.form, panel, s).across);
}

Eigen::Vector3d leaf_normal(const LeafRow& row, int panel, double s) {
  const SectionPoint point = row.section->point(row.form, panel, s);
  const Eigen::Vector3d across = in_space(point.across);
  Eigen::Vector3d normal = own_derivative_m(row, point).cross(across);
  const double norm = normal.norm();
  normal = norm > 1e-9 * row.length_m ? Eigen::Vector3d(normal / norm)
                                      : Eigen::Vector3d(Eigen::Vector3d::UnitZ().cross(across));
  return row.frame * normal;
}
Eigen::Vector3d leaf_normal(const LeafRow& row, double s) {
  return leaf_normal(row, panel_at(row, s), s);
}

std::vector<double> width_zeros(const OrganAttributes& leaf, std::span<const double> between) {
  std::vector<double> out;
  if (!leaf.f_width) return out;
  constexpr int looks = 4, halvings = 50;
  double from = 0, at_from = leaf.f_width->value(0);
  for (std::size_t i = 0; i + 1 < between.size(); ++i) {
    for (int k = 1; k <= looks; ++k) {
      const double to = between[i] + (between[i + 1] - between[i]) * k / looks;
      const double at_to = leaf.f_width->value(to);
      if (at_from * at_to < 0) {
        double low = from, high = to;
        for (int h = 0; h < halvings; ++h) {
          const double middle = (low + high) / 2;
          (leaf.f_width->value(middle) * at_from > 0 ? low : high) = middle;
        }
        out.push_back((low + high) / 2);
      }
      from = to, at_from = at_to;
    }
  }
  return out;
}

}  // namespace bpms
