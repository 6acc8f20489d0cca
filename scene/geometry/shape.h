// Solids with a formula: ellipsoids (spheres, spheroids) and round cylinders (frusta of cones where the ends'
// radii differ), closed or without ends.
//
// Each has a frame of its own. An ellipsoid's axes are x, y, z and its centre the origin; a cylinder's axis
// is z, from its first end (z = 0) to its second. Normals look outwards. (U, V): U is the azimuth about z,
// over 2 pi, counter-clockwise from x; V runs from the bottom (0) to the top (1), on an ellipsoid as the
// angle from its lowest point over pi, on a cylinder's side along the axis. A cylinder's ends have no
// tangents, V is 0 or 1 there. What a ray meets is computed in double precision.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "scene/rotation.h"

namespace bpms {

struct Shape {
  enum class Kind : std::uint8_t { ellipsoid, cylinder };
  Eigen::Vector3f centre_m = Eigen::Vector3f::Zero();  // of an ellipsoid; of a cylinder's first end
  Rotation rotation;                                   // from the shape's frame
  Eigen::Vector3f size_m = Eigen::Vector3f::Ones();    // radii; of a cylinder: first, second radius, length
  std::uint32_t material = 0;                          // index into Scene::materials
  Kind kind = Kind::ellipsoid;
  bool closed = true;  // false: a cylinder without ends, which has an inside that rays can get into
};

Shape sphere(const Eigen::Vector3d& centre_m, double radius_m, std::uint32_t material = 0);
Shape ellipsoid(const Eigen::Vector3d& centre_m, const Eigen::Vector3d& radii_m, const Rotation& rotation,
                std::uint32_t material = 0);
Shape cylinder(const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m, double first_radius_m,
               double second_radius_m, bool closed = true, std::uint32_t material = 0);

// The parts of a surface.
inline constexpr int shape_side = 0, shape_first_end = 1, shape_second_end = 2;

// Where a line crosses the surface; `at` in the shape's frame, but of an ellipsoid on the unit sphere.
struct ShapeCrossing {
  double t = 0;
  int part = shape_side;
  bool entering = true;
  Eigen::Vector3d at;
};
// At most two, in order along the line; how many. `direction` need not be a unit vector.
int shape_crossings(const Shape& shape, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                    std::array<ShapeCrossing, 2>& out);

// The surface at a crossing, in the frame that the shape stands in.
struct ShapePoint {
  Eigen::Vector3d position, normal;
  Eigen::Vector2d uv;
  Eigen::Vector3d dp_du, dp_dv;  // zero where there is no UV
};
ShapePoint shape_point(const Shape& shape, int part, const Eigen::Vector3f& at);
// The outward normal at the surface's point near `position`.
Eigen::Vector3d shape_normal(const Shape& shape, int part, const Eigen::Vector3d& position);
// How far a point near the surface lies outside of that part (below 0: inside), to first order.
double shape_offset(const Shape& shape, int part, const Eigen::Vector3d& position);
bool shape_contains(const Shape& shape, const Eigen::Vector3d& position);  // false for open ones

double shape_area_m2(const Shape& shape);     // of all its surface
double shape_thinnest_m(const Shape& shape);  // its smallest width
// Half the width of the box around it, and the box's middle.
void shape_box(const Shape& shape, Eigen::Vector3d& middle, Eigen::Vector3d& half);
// The point that lies furthest along a direction.
Eigen::Vector3d shape_support(const Shape& shape, const Eigen::Vector3d& direction);

}  // namespace bpms
