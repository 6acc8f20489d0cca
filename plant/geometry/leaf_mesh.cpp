// A leaf as a strip: rows along the midrib by halving, the same even number of columns in every row, so that
// no vertex lies on a neighbour's edge. Chords are shorter than arcs: the section's polygon and the midrib's
// steps are stretched to the true arc lengths, and what then is missing or too much of the area goes into a
// common factor on the width, as long as that moves no vertex by more than a fraction of the tolerance.
#include <Eigen/Geometry>
#include <cmath>

#include "plant/geometry/leaf_surface.h"
#include "plant/geometry/mesh_parts.h"
#include "plant/geometry/subdivide.h"
#include "plant/plant_mesh.h"

namespace bpms {
namespace {

double across(int column, int columns) {
  return 2.0 * column / columns - 1;
}

// Enough columns that the section's polygon (add_row) stays within `tolerance_m` of its arc: w c / (6 n^2).
int column_count(const OrganAttributes& leaf, double tolerance_m) {
  constexpr int samples = 64, most = 256;
  std::vector<double> l;
  for (int i = 0; i <= samples; ++i) l.push_back(static_cast<double>(i) / samples);
  double widest = 0;
  if (leaf.f_curvature) {
    for (const LeafRow& row : leaf_rows(leaf, l))
      widest = std::max(widest, row.width_m * std::abs(row.half_angle));
  }
  const int pairs = static_cast<int>(std::ceil(std::sqrt(widest / (6 * tolerance_m)) / 2));
  return 2 * std::clamp(pairs, 1, most / 2);
}

// How far five rows' surface lies from the cells between the outer two.
double deviation_m(const LeafRow* rows, int columns) {
  double worst = 0;
  for (int j = 0; j <= columns; ++j) {
    const double s = across(j, columns);
    const Eigen::Vector3d first = leaf_point_m(rows[0], s);
    const Eigen::Vector3d last = leaf_point_m(rows[4], s);
    for (int k = 1; k <= 3; ++k)
      worst = std::max(worst, distance_from_line(leaf_point_m(rows[k], s), first, last));
    if (j == columns) break;
    // The middle of the cell between two chords across, against both diagonals.
    const double s_next = across(j + 1, columns);
    const Eigen::Vector3d middle = (leaf_point_m(rows[2], s) + leaf_point_m(rows[2], s_next)) / 2;
    const Eigen::Vector3d normal = leaf_normal(rows[2], (s + s_next) / 2);
    const Eigen::Vector3d diagonals[] = {(first + leaf_point_m(rows[4], s_next)) / 2,
                                         (last + leaf_point_m(rows[0], s_next)) / 2};
    for (const Eigen::Vector3d& diagonal : diagonals)
      worst = std::max(worst, std::abs(normal.dot(middle - diagonal)));
  }
  return worst;
}

struct Grid {
  std::vector<double> nodes;  // l of the rows
  int columns = 2;
  double point_below_m = 0;  // a row narrower than this is one vertex
  double width_factor = 1;
};

VertexRow add_row(OrganMesh& mesh, const LeafRow& row, const Eigen::Vector3d& midrib_m, const Grid& grid) {
  const auto first = static_cast<std::uint32_t>(mesh.positions_m.size());
  if (row.width_m <= grid.point_below_m) {
    mesh.add(midrib_m, leaf_normal(row, 0), row.l, 0.5);
    return {first, 1};
  }
  // The polygon is as long as the arc, and shifted so that its mean lies where the arc's does: bending then
  // stretches both alike. With half a step h the shift is R h^2 / 3.
  const double half_step = row.half_angle / grid.columns;
  const double stretch = std::abs(half_step) < 1e-6 ? 1 : half_step / std::sin(half_step);
  const Eigen::Vector3d shift(row.width_m * row.half_angle / (6.0 * grid.columns * grid.columns), 0, 0);
  for (int j = 0; j <= grid.columns; ++j) {
    const double s = across(j, grid.columns);
    const Eigen::Vector3d section = grid.width_factor * stretch * leaf_section_m(row, s) + shift;
    mesh.add(midrib_m + row.frame * section, leaf_normal(row, s), row.l, (s + 1) / 2);
  }
  return {first, static_cast<std::uint32_t>(grid.columns) + 1};
}

OrganMesh strip(const OrganAttributes& leaf, const Grid& grid) {
  OrganMesh mesh;
  const std::vector<LeafRow> rows = leaf_rows(leaf, grid.nodes);
  Eigen::Vector3d midrib_m = rows[0].midrib_m;
  VertexRow before = add_row(mesh, rows[0], midrib_m, grid);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const Eigen::Vector3d chord = rows[i].midrib_m - rows[i - 1].midrib_m;
    const double arc = leaf.length_m * (rows[i].l - rows[i - 1].l);
    midrib_m += chord.norm() > 0.5 * arc ? Eigen::Vector3d(chord.normalized() * arc) : chord;
    const VertexRow row = add_row(mesh, rows[i], midrib_m, grid);
    join_rows(mesh, before, row);
    before = row;
  }
  return mesh;
}

double widest_m(const OrganAttributes& leaf, const Grid& grid) {
  double out = 0;
  for (const LeafRow& row : leaf_rows(leaf, grid.nodes)) out = std::max(out, row.width_m);
  return out;
}

struct Trial {
  Grid grid;
  double row_tolerance;
  OrganMesh mesh;
  double area_error;  // relative
  double cost() const { return area_error * static_cast<double>(mesh.triangles.size()); }
};

}  // namespace

OrganMesh leaf_mesh(const OrganAttributes& leaf, double tolerance_m) {
  if (leaf.length_m <= 0 || leaf.width_m <= 0) return {};
  constexpr int most_rounds = 6;
  constexpr std::size_t most_triangles = 100000;
  const double true_area = leaf_surface_area_m2(leaf);
  if (true_area <= 0) return {};
  const double least_gap = std::clamp(0.1 * tolerance_m / leaf.length_m, 1e-6, 1e-2);
  const auto rows = [&](const std::vector<double>& l) { return leaf_rows(leaf, l); };
  const double point_below_m = std::max(1e-5 * leaf.width_m, 1e-6 * std::min(1.0, leaf.length_m));
  const auto refined = [&](const std::vector<double>& nodes, int columns, double row_tolerance) {
    Trial out{{nodes, columns, point_below_m, 1}, row_tolerance, {}, 0};
    const auto deviation = [&](const LeafRow* five) { return deviation_m(five, columns); };
    out.grid.nodes = subdivide(nodes, rows, deviation, row_tolerance, least_gap);
    out.mesh = strip(leaf, out.grid);
    out.area_error = std::abs(true_area / out.mesh.area_m2() - 1);
    return out;
  };
  Trial trial =
      refined(first_nodes(leaf, least_gap), column_count(leaf, 0.2 * tolerance_m), 0.4 * tolerance_m);
  const double error_allowed = 0.4 * tolerance_m / widest_m(leaf, trial.grid);  // by the width's factor
  for (int round = 0; round < most_rounds; ++round) {
    if (trial.area_error <= error_allowed || trial.mesh.triangles.size() > most_triangles) break;
    // A twisted strip wants more columns, a bent one more rows: whichever gains more for its triangles.
    Trial finer = refined(trial.grid.nodes, trial.grid.columns, trial.row_tolerance / 4);
    Trial wider = refined(trial.grid.nodes, 2 * trial.grid.columns, trial.row_tolerance);
    trial = finer.cost() < wider.cost() ? std::move(finer) : std::move(wider);
  }
  Grid grid = trial.grid;
  OrganMesh mesh = std::move(trial.mesh);
  for (int i = 0; i < 2; ++i) {
    grid.width_factor *= std::clamp(true_area / mesh.area_m2(), 0.99, 1.01);
    mesh = strip(leaf, grid);
  }
  return mesh;
}

}  // namespace bpms
