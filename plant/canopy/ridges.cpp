#include "plant/canopy/ridges.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace bpms {
namespace {

constexpr double nodes_a_ridge = 16;
constexpr double most_nodes = 4e6;

void refuse_many_nodes(double nodes, const TomlValue& table) {
  if (nodes > most_nodes)
    table.reject(
        fmt::format("the ridges would take {:.3g} nodes, more than {:.3g}: give a coarser resolution_m",
                    nodes, most_nodes));
}

// One axis of a grid over [-half, half]: `step` as wanted, nodes on `through` where the field is open.
struct GridAxis {
  double low_m, spacing_m;
  std::size_t nodes;
};

GridAxis periodic_axis(double size_m, double step_m) {
  const double squares = std::max(1.0, std::ceil(size_m / step_m - 1e-6));
  return {-0.5 * size_m, size_m / squares, static_cast<std::size_t>(squares) + 1};
}
GridAxis open_axis(double size_m, double step_m, double through_m) {
  const double before = std::ceil((through_m + 0.5 * size_m) / step_m - 1e-6);
  const double low = through_m - before * step_m;
  const double squares = std::max(1.0, std::ceil((0.5 * size_m - low) / step_m - 1e-6));
  return {std::min(low, -0.5 * size_m), step_m, static_cast<std::size_t>(squares) + 1};
}

void read_profile(const TomlValue& table, double spacing_m, Ridges& out) {
  out.height_m = table.require("height_m").positive();
  constexpr double highest_m = 1000;
  if (out.height_m > highest_m) table.get("height_m").reject("expected a height up to 1000 m");
  const std::string shape = table.require("shape").one_of({"cosine", "triangle", "trapezoid"});
  out.shape = shape == "cosine"     ? Ridges::Shape::cosine
              : shape == "triangle" ? Ridges::Shape::triangle
                                    : Ridges::Shape::trapezoid;
  out.width_m = spacing_m;
  if (const TomlValue width = table.get("width_m")) {
    out.width_m = width.positive();
    if (out.width_m > spacing_m * (1 + 1e-9))
      width.reject(fmt::format("{:.6g} m at the foot, expected no more than the ridges' spacing, {:.6g} m",
                               out.width_m, spacing_m));
  }
  const TomlValue top = table.get("top_m");
  if (top && out.shape != Ridges::Shape::trapezoid) top.reject("only a trapezoid has a flat top");
  if (out.shape != Ridges::Shape::trapezoid) return;
  constexpr double usual_top = 1.0 / 3;
  out.top_m = top ? top.positive() : usual_top * out.width_m;
  if (top && out.top_m >= out.width_m)
    top.reject(
        fmt::format("{:.6g} m, expected less than the width at the foot, {:.6g} m", out.top_m, out.width_m));
}

}  // namespace

double Ridges::height_at(const Eigen::Vector2d& xy) const {
  const double from = (xy.dot(lines.across) - lines.offset_m) / lines.spacing_m;
  const double d = std::abs(from - std::round(from)) * lines.spacing_m;
  const double half = 0.5 * width_m;
  if (d >= half) return 0;
  if (shape == Shape::cosine) return 0.5 * height_m * (1 + std::cos(pi * d / half));
  return height_m * std::min(1.0, (half - d) / (half - 0.5 * top_m));
}

Ridges read_ridges(const TomlValue& table, PlantingField& field) {
  Ridges out;
  const TomlValue spacing = table.get("spacing_m"), azimuth = table.get("azimuth_deg");
  const TomlValue on = table.get("plants_on");
  for (const char* later : {"height_m", "shape", "width_m", "top_m", "phase", "resolution_m"})
    table.get(later);
  if (spacing) {
    out.lines =
        fit_row_lines(spacing.positive(), radians(azimuth ? azimuth.number() : 0), "ridges", spacing, field);
    if (on) on.reject("ridges with a spacing of their own do not go with the rows; give phase");
  } else {
    if (azimuth) azimuth.reject("the azimuth is the rows'; give spacing_m too for other ridges");
    if (!field.rows) table.reject_choice("without rows the ridges need spacing_m (and azimuth_deg)");
    out.lines = *field.rows;
  }
  double phase = table.number_or("phase", 0);
  if (on && on.one_of({"ridge", "furrow"}) == "furrow") phase += 0.5;
  read_profile(table, out.lines.spacing_m, out);
  out.lines.offset_m += (phase - std::floor(phase)) * out.lines.spacing_m;
  out.resolution_m = out.lines.spacing_m / nodes_a_ridge;
  if (const TomlValue resolution = table.get("resolution_m")) out.resolution_m = resolution.positive();
  return out;
}

Terrain ridged_ground(const Ridges& ridges, const PlantingField& field, const TomlValue& table) {
  GridAxis axes[2];
  double nodes = 1;
  for (int k = 0; k < 2; ++k) {
    const double across = std::abs(ridges.lines.across[k]);
    // Along the ridges nothing changes; one square is enough.
    const double step = across < 1e-9 ? field.size_m[k] : ridges.resolution_m;
    nodes *= field.size_m[k] / step + 2;
    refuse_many_nodes(nodes, table);
    // Nodes on the middles of ridges that run along an axis.
    const double through = across > 1 - 1e-9 ? ridges.lines.offset_m * ridges.lines.across[k] : 0;
    axes[k] = field.periodic  ? periodic_axis(field.size_m[k], step)
              : across < 1e-9 ? GridAxis{-0.5 * field.size_m[k], field.size_m[k], 2}
                              : open_axis(field.size_m[k], step, through);
  }
  Terrain out;
  out.columns = axes[0].nodes, out.rows = axes[1].nodes;
  out.low_m = {axes[0].low_m, axes[1].low_m};
  out.spacing_m = {axes[0].spacing_m, axes[1].spacing_m};
  out.heights_m.reserve(out.columns * out.rows);
  for (std::size_t j = 0; j < out.rows; ++j) {
    for (std::size_t i = 0; i < out.columns; ++i) {
      // Opposite edges of a period are the same place, to the last bit.
      const std::size_t column = field.periodic && i + 1 == out.columns ? 0 : i;
      const std::size_t row = field.periodic && j + 1 == out.rows ? 0 : j;
      const Eigen::Vector2d node(static_cast<double>(column), static_cast<double>(row));
      out.heights_m.push_back(
          static_cast<float>(ridges.height_at(out.low_m + node.cwiseProduct(out.spacing_m))));
    }
  }
  make_terrain_mesh(out, field.periodic);
  return out;
}

Terrain ridged_terrain(const Ridges& ridges, const Terrain& below, bool periodic, const TomlValue& table) {
  // As often along x as along y: the diagonals of the fine squares then lie on those of the coarse ones.
  const double divide = std::max(1.0, std::ceil(below.spacing_m.maxCoeff() / ridges.resolution_m - 1e-6));
  refuse_many_nodes(
      (divide * static_cast<double>(below.columns)) * (divide * static_cast<double>(below.rows)), table);
  const auto fine = static_cast<std::size_t>(divide);
  Terrain out;
  out.columns = (below.columns - 1) * fine + 1, out.rows = (below.rows - 1) * fine + 1;
  out.low_m = below.low_m;
  out.spacing_m = below.spacing_m / divide;
  out.heights_m.reserve(out.columns * out.rows);
  for (std::size_t j = 0; j < out.rows; ++j) {
    for (std::size_t i = 0; i < out.columns; ++i) {
      const std::size_t column = periodic && i + 1 == out.columns ? 0 : i;
      const std::size_t row = periodic && j + 1 == out.rows ? 0 : j;
      const Eigen::Vector2d node(static_cast<double>(column), static_cast<double>(row));
      const Eigen::Vector2d xy = out.low_m + node.cwiseProduct(out.spacing_m);
      out.heights_m.push_back(static_cast<float>(below.height_m(xy) + ridges.height_at(xy)));
    }
  }
  make_terrain_mesh(out, periodic);
  return out;
}

}  // namespace bpms
