// A leaf as a strip: rows along the midrib by halving, the same columns in every row, so that no vertex lies
// on a neighbour's edge; columns lie on the section's folds, one on either side of each with its own normals.
// Chords are shorter than arcs: the section's polygon and the midrib's steps are stretched to the true
// lengths, and what then is missing or too much of the area goes into a common factor on the width, as long
// as that moves no vertex by more than a fraction of the tolerance.
#include <Eigen/Geometry>
#include <cmath>

#include "plant/geometry/frame_rate.h"
#include "plant/geometry/leaf_surface.h"
#include "plant/geometry/mesh_parts.h"
#include "plant/geometry/subdivide.h"
#include "plant/plant_mesh.h"

namespace bpms {
namespace {

struct Column {
  double s;
  int panel;
  double step;  // of its panel's pieces, in s
};

// The panels cut in `times` as many pieces as their curves need.
std::vector<Column> leaf_columns(const OrganAttributes& leaf, const std::vector<LeafRow>& rows, int times,
                                 double tolerance_m) {
  const LeafSection& section = leaf_section(leaf.section);
  int pieces = 1;
  for (const LeafRow& row : rows)
    if (row.width_m > 0) pieces = std::max(pieces, section.pieces(row.form, tolerance_m / row.width_m));
  pieces *= times;
  const std::vector<double> ends = panel_ends(leaf);
  std::vector<Column> out;
  for (std::size_t p = 0; p + 1 < ends.size(); ++p) {
    const double extent = ends[p + 1] - ends[p];
    for (int k = 0; k <= pieces; ++k)
      out.push_back({ends[p] + extent * k / pieces, static_cast<int>(p), extent / pieces});
  }
  return out;
}

double widest_m(const std::vector<LeafRow>& rows) {
  double out = 0;
  for (const LeafRow& row : rows) out = std::max(out, row.width_m);
  return out;
}

// How far five rows' surface lies from the cells between the outer two.
class LeafDeviation {
 public:
  explicit LeafDeviation(const std::vector<Column>& columns)
      : columns_(columns), points_(5 * columns.size()) {}

  double operator()(const FiveRows<LeafRow>& rows) const {
    const std::size_t n = columns_.size();
    for (std::size_t k = 0; k < 5; ++k)
      for (std::size_t j = 0; j < n; ++j)
        points_[k * n + j] = leaf_point_m(*rows[k], columns_[j].panel, columns_[j].s);
    double worst = 0;
    for (std::size_t j = 0; j < n; ++j) {
      const Eigen::Vector3d &first = points_[j], &last = points_[4 * n + j];
      for (std::size_t k = 1; k <= 3; ++k)
        worst = std::max(worst, distance_from_line(points_[k * n + j], first, last));
      if (j + 1 == n || columns_[j + 1].panel != columns_[j].panel) continue;
      // The middle of the cell between two chords across, against both diagonals.
      const Eigen::Vector3d middle = (points_[2 * n + j] + points_[2 * n + j + 1]) / 2;
      const Eigen::Vector3d normal =
          leaf_normal(*rows[2], columns_[j].panel, (columns_[j].s + columns_[j + 1].s) / 2);
      const Eigen::Vector3d one = (first + points_[4 * n + j + 1]) / 2, other = (last + points_[j + 1]) / 2;
      worst = std::max({worst, std::abs(normal.dot(middle - one)), std::abs(normal.dot(middle - other))});
    }
    return worst;
  }

 private:
  const std::vector<Column>& columns_;
  mutable std::vector<Eigen::Vector3d> points_;
};

// The strip over given rows and columns: where its corners lie for a width that is stretched by a factor, and
// the triangles between them.
class LeafStrip {
 public:
  LeafStrip(const std::vector<LeafRow>& rows, const std::vector<Column>& columns, double point_below_m)
      : columns_(columns), panels_(static_cast<std::size_t>(columns.back().panel) + 1) {
    corners_.reserve(rows.size() * columns.size());
    Eigen::Vector3d midrib_m = rows[0].midrib_m;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i > 0) midrib_m += stretched(rows[i - 1], rows[i]);
      add(rows[i], midrib_m, rows[i].width_m <= point_below_m);
    }
    mesh_.positions_m.resize(corners_.size());
    stretch(1);
    mesh_.triangles.reserve(2 * corners_.size());
    for (std::size_t i = 0; i + 1 < rows_.size(); ++i)
      for (std::size_t p = 0; p < panels_; ++p) join_rows(mesh_, part(rows_[i], p), part(rows_[i + 1], p));
  }

  void stretch(double width_factor) {
    for (std::size_t k = 0; k < corners_.size(); ++k)
      mesh_.positions_m[k] = corners_[k].midrib_m + width_factor * corners_[k].section_m;
  }
  const OrganMesh& mesh() const { return mesh_; }
  OrganMesh with_normals() && {
    mesh_.normals.reserve(corners_.size());
    mesh_.uv.reserve(corners_.size());
    for (const Corner& c : corners_) {
      mesh_.normals.push_back(leaf_normal(*c.row, c.panel, c.s));
      mesh_.uv.emplace_back(c.row->l, c.point ? 0.5 : (c.s + 1) / 2);
    }
    return std::move(mesh_);
  }

 private:
  struct Corner {
    Eigen::Vector3d midrib_m, section_m;
    const LeafRow* row;
    int panel;
    double s;
    bool point;
  };
  // One vertex a column, or one a panel where the row has shrunk to a point.
  struct Vertices {
    std::uint32_t first = 0;
    bool is_point = false;
  };

  static Eigen::Vector3d stretched(const LeafRow& from, const LeafRow& to) {
    const Eigen::Vector3d chord = to.midrib_m - from.midrib_m;
    const double arc = to.length_m * (to.l - from.l), norm = chord.norm();
    return norm > 0.5 * arc ? Eigen::Vector3d(chord * (arc / norm)) : chord;
  }
  std::size_t across() const { return columns_.size() / panels_; }

  void add(const LeafRow& row, const Eigen::Vector3d& midrib_m, bool is_point) {
    rows_.push_back({static_cast<std::uint32_t>(corners_.size()), is_point});
    for (std::size_t p = 0; is_point && p < panels_; ++p) {
      const double middle = (columns_[across() * p].s + columns_[across() * (p + 1) - 1].s) / 2;
      corners_.push_back({midrib_m, Eigen::Vector3d::Zero(), &row, static_cast<int>(p), middle, true});
    }
    if (is_point) return;
    for (const Column& c : columns_) {
      const Eigen::Vector2d at = row.width_m * row.section->corner(row.form, c.panel, c.s, c.step);
      corners_.push_back({midrib_m, row.frame.leftCols<2>() * at, &row, c.panel, c.s, false});
    }
  }
  VertexRow part(const Vertices& row, std::size_t panel) const {
    const auto p = static_cast<std::uint32_t>(panel), n = static_cast<std::uint32_t>(across());
    return row.is_point ? VertexRow{row.first + p, 1} : VertexRow{row.first + p * n, n};
  }

  const std::vector<Column>& columns_;
  std::size_t panels_;
  std::vector<Corner> corners_;
  std::vector<Vertices> rows_;
  OrganMesh mesh_;
};

class LeafMesher {
 public:
  LeafMesher(const OrganAttributes& leaf, double tolerance_m)
      : leaf_(leaf),
        tolerance_m_(tolerance_m),
        least_gap_(std::clamp(0.1 * tolerance_m / leaf.length_m, 1e-6, 1e-2)),
        point_below_m_(std::max(1e-5 * leaf.width_m, 1e-6 * std::min(1.0, leaf.length_m))) {}

  OrganMesh mesh() {
    nodes_ = first_nodes(leaf_, least_gap_);
    add_zeros();
    Trial trial = refined(nodes_, 1, 0.4 * tolerance_m_);
    std::vector<double> ends;
    for (const LeafRow& row : trial.rows) ends.push_back(row.l);
    true_area_ = leaf_area_m2(leaf_, ends);
    if (!(true_area_ > 0)) return {};
    trial.area_error = error_of(trial);
    // As far as the width's factor may move the edges.
    const double error_allowed = 0.4 * tolerance_m_ / widest_m(trial.rows);
    for (int round = 0; round < most_rounds; ++round) {
      if (trial.area_error <= error_allowed || trial.triangles > most_triangles) break;
      trial = better(trial);
    }
    LeafStrip strip(trial.rows, trial.columns, point_below_m_);
    // Coarse levels of detail, whose tolerance is of the order of the width, have more to make up for.
    const double most_stretch = std::clamp(error_allowed, 0.01, 0.3);
    double factor = 1, area = trial.area_m2;
    for (int i = 0; i < 2; ++i) {
      factor *= std::clamp(true_area_ / area, 1 - most_stretch, 1 + most_stretch);
      strip.stretch(factor);
      area = strip.mesh().area_m2();
    }
    return std::move(strip).with_normals();
  }

 private:
  static constexpr int most_rounds = 6;
  static constexpr std::size_t most_triangles = 100000;

  struct Trial {
    std::vector<LeafRow> rows;
    std::vector<Column> columns;
    int times;  // columns, of what the section's curve needs
    double row_tolerance;
    double area_m2 = 0;
    std::size_t triangles = 0;
    double area_error = 0;  // relative
    double cost() const { return area_error * static_cast<double>(triangles); }
  };

  void add_zeros() {
    for (const double l : width_zeros(leaf_, nodes_)) {
      const auto after = std::ranges::upper_bound(nodes_, l);
      if (l - *(after - 1) > least_gap_ && *after - l > least_gap_) nodes_.insert(after, l);
    }
  }

  Trial refined(const std::vector<double>& nodes, int times, double row_tolerance) const {
    const std::vector<LeafRow> rows = leaf_rows(leaf_, with_quarters(nodes));
    Trial out{{}, leaf_columns(leaf_, rows, times, 0.2 * tolerance_m_), times, row_tolerance};
    const LeafDeviation deviation(out.columns);
    const auto between = [&](const LeafRow& a, const LeafRow& b) {
      const double l = (a.l + b.l) / 2;
      return leaf_row(leaf_, *a.section, l,
                      a.midrib_m + leaf_.length_m * short_midrib_step(leaf_, a.l, l, a.rate));
    };
    const auto gap = [](const LeafRow& a, const LeafRow& b) { return b.l - a.l; };
    out.rows = subdivide(rows, between, gap, deviation, row_tolerance, least_gap_);
    const LeafStrip strip(out.rows, out.columns, point_below_m_);
    out.area_m2 = strip.mesh().area_m2();
    out.triangles = strip.mesh().triangles.size();
    return out;
  }
  double error_of(const Trial& trial) const { return std::abs(true_area_ / trial.area_m2 - 1); }

  // A twisted strip wants more columns, a bent one more rows: whichever gains more for its triangles.
  Trial better(const Trial& than) const {
    std::vector<double> nodes;
    for (const LeafRow& row : than.rows) nodes.push_back(row.l);
    Trial finer = refined(nodes, than.times, than.row_tolerance / 4);
    Trial wider = refined(nodes, 2 * than.times, than.row_tolerance);
    for (Trial* trial : {&finer, &wider}) trial->area_error = error_of(*trial);
    return finer.cost() < wider.cost() ? std::move(finer) : std::move(wider);
  }

  const OrganAttributes& leaf_;
  double tolerance_m_, least_gap_, point_below_m_;
  std::vector<double> nodes_;
  double true_area_ = 0;
};

}  // namespace

OrganMesh leaf_mesh(const OrganAttributes& leaf, double tolerance_m) {
  if (leaf.length_m <= 0 || leaf.width_m <= 0) return {};
  return LeafMesher(leaf, tolerance_m).mesh();
}

}  // namespace bpms
