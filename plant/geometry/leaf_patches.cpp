#include "plant/leaf_patches.h"

#include <Eigen/Geometry>
#include <cmath>
#include <iterator>

#include "plant/geometry/frame_rate.h"
#include "plant/geometry/leaf_surface.h"
#include "plant/geometry/subdivide.h"

namespace bpms {
namespace {

struct Corner4 {
  Eigen::Vector3d at, by_l, by_s, by_both;
};

// The surface and its derivatives; `rates` is the row that the rates are taken from, on the patch's own side
// of a kink.
Corner4 corner(const LeafRow& row, const LeafRow& rates, int panel, double s) {
  const auto flat = [](const Eigen::Vector2d& v) { return Eigen::Vector3d(v.x(), v.y(), 0); };
  constexpr double step = 1e-5;
  SectionForm less = row.form, more = row.form;
  less.half_angle -= step, more.half_angle += step;
  const Eigen::Vector2d across = row.section->point(row.form, panel, s).across;
  const Eigen::Vector2d across_rate =
      rates.half_angle_rate / (2 * step) *
      (row.section->point(more, panel, s).across - row.section->point(less, panel, s).across);
  const Eigen::Vector3d by_s = row.width_m / 2 * flat(across);
  LeafRow at_kink = rates;
  at_kink.frame = row.frame, at_kink.form = row.form, at_kink.width_m = row.width_m;
  return {leaf_point_m(row, panel, s), leaf_derivative_m(at_kink, panel, s), row.frame * by_s,
          row.frame * (rates.rate.cross(by_s) + rates.width_rate_m / 2 * flat(across) +
                       row.width_m / 2 * flat(across_rate))};
}

BezierPatch hermite_patch(const Corner4 (&c)[2][2], double step_l, double step_s) {
  BezierPatch out;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      const double u = (i == 0 ? step_l : -step_l) / 3, v = (j == 0 ? step_s : -step_s) / 3;
      const std::size_t i0 = 3 * i, j0 = 3 * j, i1 = i == 0 ? 1 : 2, j1 = j == 0 ? 1 : 2;
      const Corner4& k = c[i][j];
      out[4 * i0 + j0] = k.at;
      out[4 * i1 + j0] = k.at + u * k.by_l;
      out[4 * i0 + j1] = k.at + v * k.by_s;
      out[4 * i1 + j1] = k.at + u * k.by_l + v * k.by_s + u * v * k.by_both;
    }
  }
  return out;
}

class LeafPatcher {
 public:
  LeafPatcher(const OrganAttributes& leaf, double tolerance_m) : leaf_(leaf), tolerance_m_(tolerance_m) {}

  std::vector<LeafPatch> patches() {
    constexpr double least_gap = 1e-6;
    std::vector<double> nodes = first_nodes(leaf_, least_gap);
    for (const double l : width_zeros(leaf_, nodes)) nodes.insert(std::ranges::upper_bound(nodes, l), l);
    // A panel is cut across as often as the first nodes' rows ask for, then along.
    while (pieces_ < most_pieces && worst_across(nodes) > tolerance_m_ / 2) pieces_ *= 2;
    std::vector<LeafPatch> out;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) strip(nodes[i], nodes[i + 1], deepest, out);
    return out;
  }

 private:
  static constexpr int most_pieces = 64, deepest = 12;

  std::vector<LeafRow> rows_of(double from, double to) const {
    // The ends, the ends a hair inside (for the rates), and looks between them.
    constexpr double hair = 1e-7;
    std::vector<double> l{from, from + hair * (to - from)};
    for (int k = 1; k < looks; ++k) l.push_back(from + (to - from) * k / looks);
    l.push_back(to - hair * (to - from));
    l.push_back(to);
    return leaf_rows(leaf_, l);
  }

  void strip(double from, double to, int depth, std::vector<LeafPatch>& out) const {
    const std::vector<LeafRow> rows = rows_of(from, to);
    if (std::max(rows[1].width_m, rows[rows.size() - 2].width_m) <= 0) return;
    std::vector<LeafPatch> made;
    const std::vector<double> ends = panel_ends(leaf_);
    for (std::size_t p = 0; p + 1 < ends.size(); ++p) {
      for (int k = 0; k < pieces_; ++k) {
        const double step = (ends[p + 1] - ends[p]) / pieces_;
        made.push_back(patch(rows, static_cast<int>(p), ends[p] + k * step, ends[p] + (k + 1) * step));
      }
    }
    double worst = 0;
    for (const LeafPatch& patch : made) worst = std::max(worst, deviation_m(patch, rows));
    if (depth > 0 && worst > tolerance_m_) {
      strip(from, (from + to) / 2, depth - 1, out);
      strip((from + to) / 2, to, depth - 1, out);
      return;
    }
    out.insert(out.end(), made.begin(), made.end());
  }

  static LeafPatch patch(const std::vector<LeafRow>& rows, int panel, double from, double to) {
    const LeafRow &first = rows.front(), &last = rows.back();
    const Corner4 corners[2][2] = {
        {corner(first, rows[1], panel, from), corner(first, rows[1], panel, to)},
        {corner(last, rows[rows.size() - 2], panel, from), corner(last, rows[rows.size() - 2], panel, to)}};
    return {hermite_patch(corners, last.l - first.l, to - from), first.l, last.l, from, to, panel};
  }

  // At the same (l, s), which is no less than the distance from either to the other.
  double deviation_m(const LeafPatch& patch, const std::vector<LeafRow>& rows) const {
    double worst = 0;
    for (std::size_t i = 2; i + 2 < rows.size(); ++i) {
      const double u = (rows[i].l - patch.l_from) / (patch.l_to - patch.l_from);
      for (int k = 0; k <= looks; ++k) {
        const double v = static_cast<double>(k) / looks, s = patch.s_from + v * (patch.s_to - patch.s_from);
        worst = std::max(
            worst, (patch_point(patch.points, u, v).position - leaf_point_m(rows[i], patch.panel, s)).norm());
      }
    }
    return worst;
  }

  // Of the section's Hermite cubics from the section, at the nodes.
  double worst_across(const std::vector<double>& nodes) const {
    double worst = 0;
    const std::vector<double> ends = panel_ends(leaf_);
    for (const LeafRow& row : leaf_rows(leaf_, with_quarters(nodes))) {
      for (std::size_t p = 0; p + 1 < ends.size(); ++p) {
        const double step = (ends[p + 1] - ends[p]) / pieces_;
        const int panel = static_cast<int>(p);
        for (int k = 0; k < pieces_; ++k) {
          const double from = ends[p] + k * step, middle = from + step / 2;
          const SectionPoint a = row.section->point(row.form, panel, from);
          const SectionPoint b = row.section->point(row.form, panel, from + step);
          const Eigen::Vector2d cubic = (a.at + b.at) / 2 + step / 16 * (a.across - b.across);
          const Eigen::Vector2d true_at = row.section->point(row.form, panel, middle).at;
          worst = std::max(worst, row.width_m * (cubic - true_at).norm());
        }
      }
    }
    return worst;
  }

  static constexpr int looks = 4;
  const OrganAttributes& leaf_;
  double tolerance_m_;
  int pieces_ = 1;  // a panel, across
};

}  // namespace

std::vector<LeafPatch> leaf_patches(const OrganAttributes& leaf, double tolerance_m) {
  if (leaf.length_m <= 0 || leaf.width_m <= 0) return {};
  return LeafPatcher(leaf, tolerance_m).patches();
}

std::vector<BezierPatch> plant_patches(const Plant& plant, double tolerance_m) {
  std::vector<BezierPatch> out;
  for (const PlacedOrgan& organ : place_organs(plant)) {
    if (organ.kind != OrganKind::leaf) continue;
    for (const LeafPatch& patch : leaf_patches(*organ.attributes, tolerance_m)) {
      BezierPatch placed = patch.points;
      for (Eigen::Vector3d& point : placed) point = organ.plant_from_organ * point;
      out.push_back(placed);
    }
  }
  return out;
}

std::string patch_file_text(const std::vector<BezierPatch>& patches) {
  std::string out = fmt::format("{}\n", patches.size());
  for (const BezierPatch& patch : patches) {
    out += "3 3\n";
    for (const Eigen::Vector3d& p : patch)
      fmt::format_to(std::back_inserter(out), "{:.10g} {:.10g} {:.10g}\n", p.x(), p.y(), p.z());
  }
  return out;
}

}  // namespace bpms
