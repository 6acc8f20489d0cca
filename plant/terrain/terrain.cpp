#include "plant/terrain.h"

#include <algorithm>
#include <cmath>

namespace bpms {
namespace {

double node(const Terrain& terrain, std::size_t column, std::size_t row) {
  return static_cast<double>(terrain.heights_m[row * terrain.columns + column]);
}

// Slope along one axis at node i of `count`: central, at an edge across it or one-sided.
template <class Height>
double slope(std::size_t i, std::size_t count, double spacing_m, bool repeats, const Height& height) {
  const std::size_t last = count - 1;
  if (i > 0 && i < last) return (height(i + 1) - height(i - 1)) / (2 * spacing_m);
  if (repeats) return (height(1) - height(last - 1)) / (2 * spacing_m);  // the two edges are one
  return i == 0 ? (height(1) - height(0)) / spacing_m : (height(last) - height(last - 1)) / spacing_m;
}

// The corners of the triangle at a point and their shares.
struct TerrainCorners {
  std::size_t node[3];
  double share[3];
};

TerrainCorners corners_at(const Terrain& terrain, const Eigen::Vector2d& at) {
  const Eigen::Vector2d p = (at - terrain.low_m).cwiseQuotient(terrain.spacing_m);
  const auto square = [](double x, std::size_t nodes) {
    return static_cast<std::size_t>(std::clamp(std::floor(x), 0.0, static_cast<double>(nodes - 2)));
  };
  const std::size_t i = square(p.x(), terrain.columns), j = square(p.y(), terrain.rows);
  const double u = std::clamp(p.x() - static_cast<double>(i), 0.0, 1.0);
  const double v = std::clamp(p.y() - static_cast<double>(j), 0.0, 1.0);
  const std::size_t sw = j * terrain.columns + i, nw = sw + terrain.columns;
  if (u >= v) return {{sw, sw + 1, nw + 1}, {1 - u, u - v, v}};
  return {{sw, nw + 1, nw}, {1 - v, u, v - u}};
}

}  // namespace

Eigen::Vector2d Terrain::size_m() const {
  return spacing_m.cwiseProduct(
      Eigen::Vector2d(static_cast<double>(columns - 1), static_cast<double>(rows - 1)));
}

bool Terrain::covers(const Eigen::Vector2d& at) const {
  const Eigen::Array2d from_low = (at - low_m).array();
  return (from_low >= 0).all() && (from_low <= size_m().array()).all();
}

double Terrain::height_m(const Eigen::Vector2d& at) const {
  const TerrainCorners corners = corners_at(*this, at);
  double out = 0;
  for (int k = 0; k < 3; ++k) out += corners.share[k] * static_cast<double>(heights_m[corners.node[k]]);
  return out;
}

Eigen::Vector3d Terrain::normal(const Eigen::Vector2d& at) const {
  const TerrainCorners corners = corners_at(*this, at);
  Eigen::Vector3d out = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) out += corners.share[k] * mesh->normals[corners.node[k]].cast<double>();
  return out.normalized();
}

double Terrain::edges_differ_by_m() const {
  double out = 0;
  for (std::size_t i = 0; i < columns; ++i)
    out = std::max(out, std::abs(node(*this, i, 0) - node(*this, i, rows - 1)));
  for (std::size_t j = 0; j < rows; ++j)
    out = std::max(out, std::abs(node(*this, 0, j) - node(*this, columns - 1, j)));
  return out;
}

void make_terrain_mesh(Terrain& terrain, bool repeats) {
  auto mesh = std::make_shared<Mesh>();
  const std::size_t nodes = terrain.columns * terrain.rows;
  mesh->positions_m.reserve(nodes);
  mesh->normals.reserve(nodes);
  mesh->uv.reserve(nodes);
  for (std::size_t j = 0; j < terrain.rows; ++j) {
    for (std::size_t i = 0; i < terrain.columns; ++i) {
      const Eigen::Vector2d share(static_cast<double>(i) / static_cast<double>(terrain.columns - 1),
                                  static_cast<double>(j) / static_cast<double>(terrain.rows - 1));
      const Eigen::Vector2d at = terrain.low_m + share.cwiseProduct(terrain.size_m());
      mesh->positions_m.push_back(Eigen::Vector3d(at.x(), at.y(), node(terrain, i, j)).cast<float>());
      mesh->uv.push_back(share.cast<float>());
      const double east = slope(i, terrain.columns, terrain.spacing_m.x(), repeats,
                                [&](std::size_t k) { return node(terrain, k, j); });
      const double north = slope(j, terrain.rows, terrain.spacing_m.y(), repeats,
                                 [&](std::size_t k) { return node(terrain, i, k); });
      mesh->normals.push_back(Eigen::Vector3d(-east, -north, 1).normalized().cast<float>());
    }
  }
  mesh->triangles.reserve(2 * (terrain.columns - 1) * (terrain.rows - 1));
  for (std::size_t j = 0; j + 1 < terrain.rows; ++j) {
    for (std::size_t i = 0; i + 1 < terrain.columns; ++i) {
      const auto sw = static_cast<std::uint32_t>(j * terrain.columns + i);
      const auto nw = static_cast<std::uint32_t>(sw + terrain.columns);
      mesh->triangles.push_back({sw, sw + 1, nw + 1});
      mesh->triangles.push_back({sw, nw + 1, nw});
    }
  }
  terrain.mesh = std::move(mesh);
}

}  // namespace bpms
