#include "scene/structure/facets.h"

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "core/units.h"
#include "plant/structure/orientation.h"

namespace bpms {
namespace {

constexpr int around = 48, along = 24;  // pieces of a shape

std::uint64_t facets_of_shape(const Shape& shape) {
  if (shape.kind == Shape::Kind::ellipsoid) return 2 * around * along;
  return 2 * around + (shape.closed ? 2 * around : 0);
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
  void deliver(double exact_area, const std::function<void(const Facet&)>& visit) {
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

// Shapes that are parts of one organ are a chain, one behind the other: the ends between them lie inside, and
// their area together is the organ's.
void visit_shapes(const Prototype& prototype, const std::function<void(const Facet&)>& visit) {
  const std::vector<Shape>& shapes = prototype.shapes;
  for (std::size_t begin = 0, end = 0; begin < shapes.size(); begin = end) {
    const std::uint32_t organ = prototype.organ_of(begin);
    end = begin + 1;
    while (organ != no_organ && end < shapes.size() && prototype.organ_of(end) == organ) ++end;
    double area = 0;
    std::vector<Facet> facets;
    for (std::size_t k = begin; k < end; ++k)
      visit_shape_facets(shapes[k],
                         [&](const Facet& facet) {
                           area += facet.area_vector.norm();
                           facets.push_back(facet);
                         },
                         {k == begin, k + 1 == end});
    const double scale = organ == no_organ || !(area > 0) ? 1 : prototype.mesh->organs[organ].area_m2 / area;
    for (Facet& facet : facets) {
      facet.area_vector *= scale;
      facet.organ = organ;
      visit(facet);
    }
  }
}

}  // namespace

void visit_shape_facets(const Shape& shape, const std::function<void(const Facet&)>& visit, ShapeEnds which) {
  ShapePart part(shape);
  if (shape.kind == Shape::Kind::ellipsoid) {
    visit_ellipsoid(shape, part);
    part.deliver(shape_area_m2(shape), visit);
    return;
  }
  const double first = shape.size_m[0], second = shape.size_m[1], length = shape.size_m[2];
  const double ends = shape.closed ? pi * (first * first + second * second) : 0;
  for (int k = 0; k < around; ++k)
    part.add(on_circle(first, k, 0), on_circle(first, k + 1, 0), on_circle(second, k + 1, length),
             on_circle(second, k, length));
  part.deliver(shape_area_m2(shape) - ends, visit);
  if (!shape.closed) return;
  for (int k = 0; which.first && k < around; ++k)
    part.add({0, 0, 0}, on_circle(first, k + 1, 0), on_circle(first, k, 0));
  part.deliver(pi * first * first, visit);
  for (int k = 0; which.second && k < around; ++k)
    part.add({0, 0, length}, on_circle(second, k, length), on_circle(second, k + 1, length));
  part.deliver(pi * second * second, visit);
}

std::uint64_t facet_count(const Prototype& prototype) {
  std::uint64_t out = prototype.discs.size() + (prototype.mesh ? prototype.mesh->triangles.size() : 0);
  for (const Shape& shape : prototype.shapes) out += facets_of_shape(shape);
  return out;
}

void visit_facets(const Prototype& prototype, const std::function<void(const Facet&)>& visit) {
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
