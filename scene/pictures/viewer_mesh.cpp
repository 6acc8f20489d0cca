// Prototypes as triangles ordered by part.
#include <array>
#include <cmath>

#include "core/units.h"
#include "scene/pictures/viewer_document.h"

namespace bpms {
namespace {

class PartMeshBuilder {
 public:
  void begin_part() {
    out_.first_triangle.push_back(static_cast<std::uint32_t>(out_.triangles.size()));
    out_.first_vertex.push_back(vertex_count());
  }
  std::uint32_t add(const Eigen::Vector3d& p) {
    out_.positions_m.push_back(p.cast<float>());
    return vertex_count() - 1;
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { out_.triangles.push_back({a, b, c}); }
  // Rows of points, `across` in each; the last of a row is joined to its first.
  void rings(std::uint32_t first, std::uint32_t rows, std::uint32_t across) {
    for (std::uint32_t r = 0; r + 1 < rows; ++r) {
      for (std::uint32_t k = 0; k < across; ++k) {
        const std::uint32_t a = first + r * across + k, b = first + r * across + (k + 1) % across;
        triangle(a, b, b + across);
        triangle(a, b + across, a + across);
      }
    }
  }
  PartMesh take() {
    begin_part();
    return std::move(out_);
  }

 private:
  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(out_.positions_m.size()); }
  PartMesh out_;
};

void add_disc(const Disc& disc, PartMeshBuilder& out) {
  constexpr std::uint32_t sides = 6;
  // A hexagon of the disc's area.
  const double radius =
      static_cast<double>(disc.radius_m) * std::sqrt(pi / (0.5 * sides * std::sin(2 * pi / sides)));
  const Eigen::Vector3d n = disc.normal.cast<double>();
  const Eigen::Vector3d a =
      (std::abs(n.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX()).cross(n).normalized();
  const Eigen::Vector3d b = n.cross(a);
  std::uint32_t first = 0;
  for (std::uint32_t k = 0; k < sides; ++k) {
    const double turn = 2 * pi * k / sides;
    const std::uint32_t vertex =
        out.add(disc.centre_m.cast<double>() + radius * (std::cos(turn) * a + std::sin(turn) * b));
    if (k == 0) first = vertex;
  }
  for (std::uint32_t k = 1; k + 1 < sides; ++k) out.triangle(first, first + k, first + k + 1);
}

void add_shape(const Shape& shape, PartMeshBuilder& out) {
  constexpr std::uint32_t across = 16, rows = 9;
  const bool round = shape.kind == Shape::Kind::ellipsoid;
  const std::uint32_t count = round ? rows : 2;
  const Eigen::Vector3d size = shape.size_m.cast<double>(), centre = shape.centre_m.cast<double>();
  const auto ring_point = [&](std::uint32_t row, std::uint32_t k) {
    const double turn = 2 * pi * k / across;
    if (round) {
      const double v = pi * row / (rows - 1);
      return Eigen::Vector3d(size.x() * std::sin(v) * std::cos(turn), size.y() * std::sin(v) * std::sin(turn),
                             -size.z() * std::cos(v));
    }
    const double radius = row == 0 ? size.x() : size.y();
    return Eigen::Vector3d(radius * std::cos(turn), radius * std::sin(turn), row == 0 ? 0.0 : size.z());
  };
  const auto add_ring = [&](std::uint32_t row) {
    std::uint32_t first = 0;
    for (std::uint32_t k = 0; k < across; ++k) {
      const std::uint32_t vertex = out.add(centre + shape.rotation * ring_point(row, k));
      if (k == 0) first = vertex;
    }
    return first;
  };
  std::uint32_t first = 0;
  for (std::uint32_t row = 0; row < count; ++row) {
    const std::uint32_t vertex = add_ring(row);
    if (row == 0) first = vertex;
  }
  out.rings(first, count, across);
  if (round || !shape.closed) return;
  for (const std::uint32_t row : {0u, 1u}) {  // ends have corners of their own, for a sharp edge
    const std::uint32_t end = add_ring(row);
    for (std::uint32_t k = 1; k + 1 < across; ++k) {
      if (row == 0) out.triangle(end, end + k + 1, end + k);
      if (row == 1) out.triangle(end, end + k, end + k + 1);
    }
  }
}

// Each organ's triangles together, with vertices of its own.
void add_organs(const Mesh& mesh, PartMeshBuilder& out) {
  std::vector<std::vector<std::uint32_t>> triangles_of(mesh.organs.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    triangles_of[mesh.organ_of_triangle[t]].push_back(static_cast<std::uint32_t>(t));
  constexpr std::uint32_t not_yet = 0xffffffffu;
  std::vector<std::uint32_t> number(mesh.positions_m.size(), not_yet);
  for (const std::vector<std::uint32_t>& own : triangles_of) {
    out.begin_part();
    for (const std::uint32_t t : own) {
      std::array<std::uint32_t, 3> corner{};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = mesh.triangles[t][k];
        if (number[vertex] == not_yet) number[vertex] = out.add(mesh.positions_m[vertex].cast<double>());
        corner[k] = number[vertex];
      }
      out.triangle(corner[0], corner[1], corner[2]);
    }
    for (const std::uint32_t t : own)
      for (const std::uint32_t vertex : mesh.triangles[t]) number[vertex] = not_yet;
  }
}

}  // namespace

PartMesh part_mesh(const Prototype& prototype, const PictureParts& parts) {
  PartMeshBuilder out;
  std::uint32_t part = 0;
  if (prototype.mesh) {
    add_organs(*prototype.mesh, out);
    part = static_cast<std::uint32_t>(prototype.mesh->organs.size());
  }
  for (; part < parts.first_shape; ++part) {
    out.begin_part();
    for (std::size_t k = 0; k < prototype.discs.size(); ++k)
      if (parts.part_of_disc[k] == part) add_disc(prototype.discs[k], out);
  }
  for (const Shape& shape : prototype.shapes) {
    out.begin_part();
    add_shape(shape, out);
  }
  return out.take();
}

std::uint64_t drawn_triangles(const Scene& scene) {
  std::uint64_t out = 0;
  for (const Instance& instance : scene.instances) {
    const Prototype& prototype = scene.prototypes[instance.prototype];
    out += (prototype.mesh ? prototype.mesh->triangles.size() : 0) + 4 * prototype.discs.size() +
           256 * prototype.shapes.size();
  }
  return out;
}

}  // namespace bpms
