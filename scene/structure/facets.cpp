#include "scene/structure/facets.h"

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "core/units.h"
#include "plant/structure/orientation.h"

namespace bpms {
namespace {

using FacetVisit = std::function<void(const Facet&)>;

constexpr int around = 48, along = 24;  // pieces of a shape

// Which ends of a cylinder are to be seen.
struct SeenEnds {
  bool first = true, second = true;
};
constexpr SeenEnds both_ends{};

std::uint64_t facets_of_shape(const Shape& shape, const SeenEnds& seen) {
  if (shape.kind == Shape::Kind::ellipsoid) return 2 * around * along;
  return 2 * around + (shape.closed && seen.first ? around : 0) + (shape.closed && seen.second ? around : 0);
}

double seen_area_m2(const Shape& shape, const SeenEnds& seen) {
  double out = shape_area_m2(shape);
  if (shape.kind == Shape::Kind::ellipsoid || !shape.closed) return out;
  if (!seen.first) out -= pi * std::pow(static_cast<double>(shape.size_m[0]), 2);
  if (!seen.second) out -= pi * std::pow(static_cast<double>(shape.size_m[1]), 2);
  return out;
}

// The links of an organ's chain follow each other; what lies a hair beyond an end tells whether it is hidden.
SeenEnds seen_ends(const Prototype& prototype, std::size_t k) {
  SeenEnds out;
  const Shape& shape = prototype.shapes[k];
  const std::uint32_t organ = prototype.organ_of(k);
  if (organ == no_organ || shape.kind == Shape::Kind::ellipsoid) return out;
  constexpr double hair = 1e-4;  // of the length
  const Eigen::Vector3d from = shape.centre_m.cast<double>(), length(0, 0, shape.size_m[2]);
  const auto hidden = [&](double along_axis) {
    const Eigen::Vector3d beyond = from + shape.rotation * (along_axis * length).eval();
    const bool before =
        k > 0 && prototype.organ_of(k - 1) == organ && shape_contains(prototype.shapes[k - 1], beyond);
    const bool behind = k + 1 < prototype.shapes.size() && prototype.organ_of(k + 1) == organ &&
                        shape_contains(prototype.shapes[k + 1], beyond);
    return before || behind;
  };
  out.first = !hidden(-hair);
  out.second = !hidden(1 + hair);
  return out;
}

// Triangles of one part of a shape, brought to its exact area when all are there.
class ShapePart {
 public:
  explicit ShapePart(const Shape& shape) : shape_(shape) {}

  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    Facet facet;
    const auto place = [&](const Eigen::Vector3d& p) {
      return (shape_.centre_m.cast<double>() + shape_.rotation * p).eval();
    };
    facet.corners = {place(a), place(b), place(c)};
    facet.area_vector =
        0.5 * (facet.corners[1] - facet.corners[0]).cross(facet.corners[2] - facet.corners[0]);
    facet.material = shape_.material;
    area_ += facet.area_vector.norm();
    facets_.push_back(facet);
  }
  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
           const Eigen::Vector3d& d) {
    add(a, b, c);
    add(a, c, d);
  }
  void deliver(double exact_area, const FacetVisit& visit) {
    for (Facet& facet : facets_) {
      facet.area_vector *= area_ > 0 ? exact_area / area_ : 0;
      visit(facet);
    }
    facets_.clear();
    area_ = 0;
  }

 private:
  const Shape& shape_;
  std::vector<Facet> facets_;
  double area_ = 0;
};

Eigen::Vector3d on_circle(double radius, int k, double z) {
  const double t = 2 * pi * k / around;
  return {radius * std::cos(t), radius * std::sin(t), z};
}

void visit_ellipsoid(const Shape& shape, ShapePart& part) {
  const Eigen::Vector3d radii = shape.size_m.cast<double>();
  const auto at = [&](int k, int row) {
    const double v = pi * row / along;
    return (radii.array() * on_circle(std::sin(v), k, -std::cos(v)).array()).matrix().eval();
  };
  for (int row = 0; row < along; ++row)
    for (int k = 0; k < around; ++k) part.add(at(k, row), at(k + 1, row), at(k + 1, row + 1), at(k, row + 1));
}

void visit_seen_facets(const Shape& shape, const SeenEnds& seen, const FacetVisit& visit) {
  ShapePart part(shape);
  if (shape.kind == Shape::Kind::ellipsoid) {
    visit_ellipsoid(shape, part);
    part.deliver(shape_area_m2(shape), visit);
    return;
  }
  const double first = shape.size_m[0], second = shape.size_m[1], length = shape.size_m[2];
  for (int k = 0; k < around; ++k)
    part.add(on_circle(first, k, 0), on_circle(first, k + 1, 0), on_circle(second, k + 1, length),
             on_circle(second, k, length));
  part.deliver(pi * (first + second) * std::hypot(length, second - first), visit);
  if (!shape.closed) return;
  for (int k = 0; seen.first && k < around; ++k)
    part.add({0, 0, 0}, on_circle(first, k + 1, 0), on_circle(first, k, 0));
  part.deliver(pi * first * first, visit);
  for (int k = 0; seen.second && k < around; ++k)
    part.add({0, 0, length}, on_circle(second, k, length), on_circle(second, k + 1, length));
  part.deliver(pi * second * second, visit);
}

void visit_shapes(const Prototype& prototype, const FacetVisit& visit) {
  std::vector<double> seen_of_organ(prototype.mesh ? prototype.mesh->organs.size() : 0, 0);
  for (std::size_t k = 0; k < prototype.shapes.size(); ++k)
    if (const std::uint32_t organ = prototype.organ_of(k); organ != no_organ)
      seen_of_organ[organ] += seen_area_m2(prototype.shapes[k], seen_ends(prototype, k));
  for (std::size_t k = 0; k < prototype.shapes.size(); ++k) {
    const std::uint32_t organ = prototype.organ_of(k);
    const double factor =
        organ == no_organ ? 1 : prototype.mesh->organs[organ].area_m2 / seen_of_organ[organ];
    visit_seen_facets(prototype.shapes[k], seen_ends(prototype, k), [&](const Facet& facet) {
      Facet own = facet;
      own.area_vector *= factor;
      own.organ = organ;
      visit(own);
    });
  }
}

}  // namespace

void visit_shape_facets(const Shape& shape, const FacetVisit& visit) {
  visit_seen_facets(shape, both_ends, visit);
}

std::uint64_t facet_count(const Prototype& prototype) {
  std::uint64_t out = prototype.discs.size() + (prototype.mesh ? prototype.mesh->triangles.size() : 0);
  for (std::size_t k = 0; k < prototype.shapes.size(); ++k)
    out += facets_of_shape(prototype.shapes[k], seen_ends(prototype, k));
  return out;
}

void visit_facets(const Prototype& prototype, const FacetVisit& visit) {
  Facet facet;
  facet.leaf = true;
  for (std::size_t k = 0; k < prototype.discs.size(); ++k) {
    const Disc& disc = prototype.discs[k];
    const double radius = disc.radius_m;
    facet.area_vector = pi * radius * radius * disc.normal.cast<double>();
    facet.corners[0] = disc.centre_m.cast<double>();
    facet.disc_radius_m = disc.radius_m;
    facet.material =
        prototype.material_of_disc.empty() ? prototype.disc_material : prototype.material_of_disc[k];
    visit(facet);
  }
  visit_shapes(prototype, visit);
  if (!prototype.mesh) return;
  const Mesh& mesh = *prototype.mesh;
  facet.disc_radius_m = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    facet.organ = mesh.organ_of_triangle.empty() ? 0 : mesh.organ_of_triangle[t];
    const bool known = facet.organ < mesh.organs.size();
    facet.leaf = known && mesh.organs[facet.organ].kind == "leaf";
    facet.material =
        facet.organ < prototype.material_of_organ.size() ? prototype.material_of_organ[facet.organ] : 0;
    for (std::size_t c = 0; c < 3; ++c)
      facet.corners[c] = mesh.positions_m[mesh.triangles[t][c]].cast<double>();
    facet.area_vector = triangle_area_vector(mesh, t);
    visit(facet);
  }
}

}  // namespace bpms
