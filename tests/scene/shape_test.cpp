// Shapes with a formula: what a line crosses against points that were put on the surface, closed forms of
// areas and volumes by rays, and rays that leave, enter and graze.
#include "scene/geometry/shape.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "scene/intersect/intersector.h"
#include "scene/intersect/parallel_rays.h"
#include "tests/scene/shapes.h"

namespace bpms {
namespace {

constexpr IntersectorOptions flat{}, instanced{1000, 0};

Rotation any_rotation(Philox& random) {
  return Rotation(
      Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal()).normalized());
}

Eigen::Vector3d point_in(Philox& random, double half_width) {
  const double x = random.uniform(-half_width, half_width), y = random.uniform(-half_width, half_width);
  return {x, y, random.uniform(-half_width, half_width)};
}

// One of each kind, of about `size` across, near `centre`.
std::vector<Shape> one_of_each(Philox& random, const Eigen::Vector3d& centre, double size) {
  const Eigen::Vector3d d = test::random_direction(random).cast<double>();
  std::vector<Shape> out{sphere(centre, 0.5 * size),
                         ellipsoid(centre, size * Eigen::Vector3d(0.6, 0.3, 0.15), any_rotation(random)),
                         ellipsoid(centre, size * Eigen::Vector3d(0.2, 0.2, 0.7), any_rotation(random))};
  for (const bool closed : {true, false}) {
    out.push_back(cylinder(centre - 0.5 * size * d, centre + 0.5 * size * d, 0.2 * size, 0.2 * size, closed));
    out.push_back(cylinder(centre - 0.5 * size * d, centre + 0.5 * size * d, 0.4 * size, 0.1 * size, closed));
  }
  out.push_back(cylinder(centre - 0.5 * size * d, centre + 0.5 * size * d, 0, 0.4 * size));  // a cone
  return out;
}

Prototype shape_prototype(std::vector<Shape> shapes) {
  Prototype out;
  out.name = "shapes";
  out.shapes = std::move(shapes);
  return out;
}

Scene shape_scene(std::vector<Shape> shapes, const Instance& instance = {}) {
  Scene scene = test::empty_scene(0, false);
  scene.prototypes = {shape_prototype(std::move(shapes))};
  scene.instances = {instance};
  return scene;
}

// Is a point in the solid that the shape bounds (of an open one, were it closed)?
bool in_solid(Shape shape, const Eigen::Vector3d& p) {
  shape.closed = true;
  return shape_contains(shape, p);
}

TEST(Shape, IsCrossedWhereMembershipChanges) {
  // Independent of the crossings' algebra: just before an entering crossing the line is outside, just after
  // it inside, and along a line without crossings no point is inside.
  Philox random(1);
  int crossed = 0, missed = 0;
  for (int k = 0; k < 3000; ++k) {
    for (const Shape& shape : one_of_each(random, point_in(random, 1), 1)) {
      const Eigen::Vector3d d = test::random_direction(random).cast<double>();
      const Eigen::Vector3d o = point_in(random, 0.7) + shape.centre_m.cast<double>() - 3 * d;
      std::array<ShapeCrossing, 2> c;
      const int count = shape_crossings(shape, o, d, c);
      for (int i = 0; i < count; ++i) {
        const ShapeCrossing& at = c[static_cast<std::size_t>(i)];
        const double step = at.entering ? 1e-7 : -1e-7;
        const bool sliver = shape.closed && c[1].t - c[0].t < 1e-6;
        if (shape.closed && !sliver) {
          EXPECT_TRUE(in_solid(shape, o + (at.t + step) * d));
          EXPECT_FALSE(in_solid(shape, o + (at.t - step) * d));
        }
        const ShapePoint point = shape_point(shape, at.part, at.at.cast<float>());
        EXPECT_LT((point.position - o - at.t * d).norm(), 3e-7);  // the place in the shape is a float
        if (std::abs(point.normal.dot(d)) > 1e-5) {
          EXPECT_EQ(point.normal.dot(d) < 0, at.entering);
        }
      }
      crossed += count;
      if (count > 0 || !shape.closed) continue;
      ++missed;
      for (int i = 0; i < 30; ++i) EXPECT_FALSE(in_solid(shape, o + random.uniform(0, 6) * d));
    }
  }
  EXPECT_GT(crossed, 10'000);
  EXPECT_GT(missed, 1'000);
}

TEST(Shape, HasNormalsAndTangentsOfItsSurface) {
  // Against differences of the position over (U,V), taken from crossings of lines nearby.
  Philox random(2);
  int checked = 0;
  for (int k = 0; k < 400; ++k) {
    for (const Shape& shape : one_of_each(random, point_in(random, 1), 1)) {
      const Eigen::Vector3d d = test::random_direction(random).cast<double>();
      const Eigen::Vector3d o = point_in(random, 0.3) + shape.centre_m.cast<double>() - 3 * d;
      std::array<ShapeCrossing, 2> c, other;
      if (shape_crossings(shape, o, d, c) == 0) continue;
      const ShapePoint at = shape_point(shape, c[0].part, c[0].at.cast<float>());
      EXPECT_NEAR(at.normal.norm(), 1, 3e-7);  // as unit as a quaternion of floats
      EXPECT_LT((shape_normal(shape, c[0].part, at.position) - at.normal).norm(), 1e-5);
      EXPECT_NEAR(shape_offset(shape, c[0].part, at.position + 1e-4 * at.normal), 1e-4, 2e-6);
      if (c[0].part != shape_side) {
        EXPECT_EQ(at.dp_du.norm() + at.dp_dv.norm(), 0);
        continue;
      }
      EXPECT_NEAR(at.normal.dot(at.dp_du), 0, 1e-6 * at.dp_du.norm());
      EXPECT_NEAR(at.normal.dot(at.dp_dv), 0, 1e-6 * at.dp_dv.norm());
      // Outside is where the tangents turn counter-clockwise.
      EXPECT_GE(at.dp_du.cross(at.dp_dv).dot(at.normal), 0);
      if (std::abs(at.normal.dot(d)) < 0.3 || std::min(at.uv.x(), 1 - at.uv.x()) < 0.01 ||
          std::min(at.uv.y(), 1 - at.uv.y()) < 0.1)
        continue;
      const Eigen::Vector3d aside = 1e-4 * test::random_direction(random).cast<double>();
      if (shape_crossings(shape, o + aside, d, other) == 0 || other[0].part != shape_side ||
          other[0].entering != c[0].entering)
        continue;
      const ShapePoint near = shape_point(shape, shape_side, other[0].at.cast<float>());
      const Eigen::Vector2d by = near.uv - at.uv;
      const Eigen::Vector3d expected = by.x() * at.dp_du + by.y() * at.dp_dv;
      // Second order: curvature 1/0.02 at the thin ends, steps of some 4e-4.
      EXPECT_LT((near.position - at.position - expected).norm(), 3e-2 * expected.norm() + 1e-6);
      ++checked;
    }
  }
  EXPECT_GT(checked, 500);
}

TEST(Shape, HasUvThatRunFromBottomToTop) {
  const Shape ball = sphere({0, 0, 0}, 2);
  EXPECT_NEAR(shape_point(ball, 0, {0, 0, -1}).uv.y(), 0, 1e-12);
  EXPECT_NEAR(shape_point(ball, 0, {0, 0, 1}).uv.y(), 1, 1e-12);
  EXPECT_NEAR(shape_point(ball, 0, {0, 1, 0}).uv.x(), 0.25, 1e-12);
  EXPECT_NEAR(shape_point(ball, 0, {0, -1, 0}).uv.x(), 0.75, 1e-12);
  const Shape stem = cylinder({0, 0, 1}, {0, 0, 4}, 0.1, 0.1);
  const ShapePoint at = shape_point(stem, 0, {-0.1f, 0, 0.75f});
  EXPECT_NEAR(at.uv.x(), 0.5, 1e-12);
  EXPECT_NEAR(at.uv.y(), 0.25, 1e-12);
  EXPECT_NEAR((at.position - Eigen::Vector3d(-0.1, 0, 1.75)).norm(), 0, 1e-7);
}

TEST(Shape, HasTheAreaOfItsFormula) {
  EXPECT_NEAR(shape_area_m2(sphere({0, 0, 0}, 2)), 4 * pi * 4, 1e-8);
  EXPECT_NEAR(shape_area_m2(cylinder({0, 0, 0}, {0, 3, 0}, 0.5, 0.5)), 2 * pi * 0.5 * 3 + 2 * pi * 0.25,
              1e-6);
  EXPECT_NEAR(shape_area_m2(cylinder({0, 0, 0}, {0, 3, 0}, 0.5, 0.5, false)), 2 * pi * 0.5 * 3, 1e-6);
  EXPECT_NEAR(shape_area_m2(cylinder({0, 0, 0}, {0, 0, 4}, 3, 0)), pi * 3 * 5 + pi * 9, 1e-6);
  // A prolate spheroid: 2 pi a^2 (1 + c / (a e) asin e), e^2 = 1 - a^2 / c^2; an oblate one:
  // 2 pi a^2 (1 + (1 - e^2) / e atanh e), e^2 = 1 - c^2 / a^2.
  const double e = std::sqrt(1 - 0.25);
  EXPECT_NEAR(shape_area_m2(ellipsoid({0, 0, 0}, {1, 1, 2}, {})), 2 * pi * (1 + 2 / e * std::asin(e)), 1e-6);
  EXPECT_NEAR(shape_area_m2(ellipsoid({0, 0, 0}, {2, 2, 1}, {})), 8 * pi * (1 + 0.25 / e * std::atanh(e)),
              1e-6);
}

// Volume by the chords of parallel rays, and a convex body's area by Cauchy's formula: four times its mean
// shadow.
TEST(Shape, HasVolumeAndAreaByRays) {
  Philox random(3);
  const Eigen::Vector3d centre(2, -1, 3);
  const std::vector<Shape> shapes{sphere(centre, 0.5),
                                  ellipsoid(centre, {0.6, 0.3, 0.2}, any_rotation(random)),
                                  cylinder(centre, centre + Eigen::Vector3d(0.3, 0.2, 0.6), 0.25, 0.25),
                                  cylinder(centre, centre + Eigen::Vector3d(0, 0.2, 0.6), 0.3, 0.1)};
  const double slant = std::hypot(0.2, 0.6);
  const double volumes[] = {4 * pi / 3 * 0.125, 4 * pi / 3 * 0.036, pi * 0.0625 * std::sqrt(0.49),
                            pi * slant / 3 * (0.09 + 0.03 + 0.01)};
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    for (const IntersectorOptions& options : {flat, instanced}) {
      const Intersector intersector(shape_scene({shapes[s]}, {0, {0, 0, 1}, 0.4, 1.5}), options);
      const Eigen::Vector3d middle = Rotation(0.4) * (1.5 * centre) + Eigen::Vector3d(0, 0, 1);
      constexpr int rays = 40'000;
      constexpr double half = 1.5;  // of the square that the rays come through
      double chords = 0, chords2 = 0, met = 0;
      for (int k = 0; k < rays; ++k) {
        const Eigen::Vector3f d = test::random_direction(random);
        const Eigen::Vector3d across = d.cast<double>().unitOrthogonal(), up = d.cast<double>().cross(across);
        const Eigen::Vector3d o = middle + random.uniform(-half, half) * across +
                                  random.uniform(-half, half) * up - 4 * d.cast<double>();
        Hit in, out;
        if (intersector.intersect({o.cast<float>(), d, 1e30f, {}}, in) != Escape::hit) continue;
        EXPECT_TRUE(in.front);
        EXPECT_LT(in.geometric_normal.dot(d), 1e-5f);
        ++met;
        const Ray inwards{in.position, d, 1e30f, in.id, in.geometric_normal, in.extent};
        if (intersector.intersect(inwards, out) != Escape::hit) {
          EXPECT_GT(in.geometric_normal.dot(d), -5e-3f);  // it only grazed
          continue;
        }
        EXPECT_TRUE(intersector.occluded(inwards));
        EXPECT_FALSE(out.front);
        const double chord = (out.position - in.position).norm();
        chords += chord, chords2 += chord * chord;
        // Outwards nothing is met again.
        Hit none;
        const Ray outwards{out.position, d, 1e30f, out.id, out.geometric_normal, out.extent};
        EXPECT_NE(intersector.intersect(outwards, none), Escape::hit);
        EXPECT_FALSE(intersector.occluded(outwards));
      }
      const double square = 4 * half * half;
      const double mean = chords / rays, error = std::sqrt((chords2 / rays - mean * mean) / rays);
      EXPECT_NEAR(mean * square, volumes[s] * 1.5 * 1.5 * 1.5, 4 * error * square) << s;
      const double share = met / rays, share_error = std::sqrt(share * (1 - share) / rays);
      EXPECT_NEAR(4 * share * square, 2.25 * shape_area_m2(shapes[s]), 16 * share_error * square) << s;
    }
  }
}

TEST(Shape, OfAMillimetreIsMetTenKilometresOut) {
  // Coordinates of 1e4 m step by 1 mm: what starts there is off by as much, but rays from the surface must
  // neither come back to it from outside nor report places off it.
  Philox random(4);
  for (const double offset : {0.0, 1e2, 1e4}) {
    for (const IntersectorOptions& options : {flat, instanced}) {
      const std::vector<Shape> shapes = one_of_each(random, {0, 0, 0}, 0.001);
      for (const Shape& shape : shapes) {
        const Intersector intersector(shape_scene({shape}, {0, {offset, -offset, offset}, 0.3, 1}), options);
        int hits = 0;
        for (int k = 0; k < 400; ++k) {
          const Eigen::Vector3f d = test::random_direction(random);
          const Eigen::Vector3d target = Eigen::Vector3d(offset, -offset, offset) + point_in(random, 2e-4);
          Hit hit, again;
          if (intersector.intersect({(target - 0.5 * d.cast<double>()).cast<float>(), d, 1e30f, {}}, hit) !=
              Escape::hit)
            continue;
          ++hits;
          EXPECT_LT((hit.position.cast<double>() - Eigen::Vector3d(offset, -offset, offset)).norm(),
                    8e-4 + 2e-7 * offset);
          for (int j = 0; j < 8; ++j) {
            Eigen::Vector3f out = test::random_direction(random);
            if ((out.dot(hit.geometric_normal) > 0) != (shape.closed || hit.front)) out = -out;
            if (!shape.closed && !hit.front) continue;
            const Ray away{hit.position, out, 1e30f, hit.id, hit.geometric_normal, hit.extent};
            EXPECT_NE(intersector.intersect(away, again), Escape::hit) << offset;
            EXPECT_FALSE(intersector.occluded(away)) << offset;
          }
        }
        EXPECT_GT(hits, 50);
      }
    }
  }
}

TEST(Shape, KeepsRaysThatStartInside) {
  // From the inner side of a closed surface every ray ends on that surface, grazing ones too: no light leaks.
  Philox random(5);
  for (const double offset : {0.0, 50.0}) {
    for (const IntersectorOptions& options : {flat, instanced}) {
      const std::vector<Shape> shapes = one_of_each(random, {0, 0, 0}, 0.01);
      for (std::size_t s = 0; s < shapes.size(); ++s) {
        if (!shapes[s].closed) continue;
        const Instance place{0, {offset, offset, 1}, Rotation::about_axes(1, 2, 3), 1};
        const Intersector intersector(shape_scene({shapes[s]}, place), options);
        int lost = 0, starts = 0;
        for (int k = 0; k < 1000; ++k) {
          const Eigen::Vector3f d = test::random_direction(random);
          const Eigen::Vector3d target = place.position_m + point_in(random, 2e-3);
          Hit hit, next;
          if (intersector.intersect({(target - 0.5 * d.cast<double>()).cast<float>(), d, 1e30f, {}}, hit) !=
              Escape::hit)
            continue;
          for (const float sine : {1.0f, 0.3f, 0.03f, 3e-3f}) {
            const Eigen::Vector3f n = hit.geometric_normal;
            const Eigen::Vector3f across =
                (Eigen::AngleAxisf(static_cast<float>(random.uniform(0, 6)), n) * n.unitOrthogonal());
            const Ray in{hit.position, (across - sine * n).normalized(), 1e30f, hit.id, n, hit.extent};
            ++starts;
            const bool met = intersector.intersect(in, next) == Escape::hit;
            EXPECT_EQ(intersector.occluded(in), met);
            if (met) {
              EXPECT_FALSE(next.front);
            } else {
              ++lost;
            }
          }
        }
        // The apex of the cone and the edges of ends are sharper than rounding: a start there may be outside.
        EXPECT_LE(lost, starts / 500) << s << " of " << starts << " at " << offset;
        EXPECT_GT(starts, 500);
      }
    }
  }
}

TEST(Shape, WithoutEndsIsSeenThrough) {
  const Intersector open(shape_scene({cylinder({0, 0, 0}, {0, 0, 2}, 0.5, 0.5, false)}));
  const Intersector closed(shape_scene({cylinder({0, 0, 0}, {0, 0, 2}, 0.5, 0.5, true)}));
  Hit hit;
  const Ray down{{0.1f, 0.2f, 5}, {0, 0, -1}, 1e30f, {}};
  EXPECT_EQ(open.intersect(down, hit), Escape::bottom);
  ASSERT_EQ(closed.intersect(down, hit), Escape::hit);
  EXPECT_FLOAT_EQ(hit.position.z(), 2);
  EXPECT_EQ(hit.id.primitive, 2u);
  // Through the open top onto the inner side, and from there across to the other inner side.
  const Eigen::Vector3f d = Eigen::Vector3f(1, 0, -1).normalized();
  ASSERT_EQ(open.intersect({{-0.2f, 0, 2.5f}, d, 1e30f, {}}, hit), Escape::hit);
  EXPECT_FALSE(hit.front);
  EXPECT_NEAR(hit.position.x(), 0.5, 1e-6);
  Hit next;
  ASSERT_EQ(open.intersect({hit.position, {-1, 0, 0}, 1e30f, hit.id}, next), Escape::hit);
  EXPECT_NEAR(next.position.x(), -0.5, 1e-6);
  EXPECT_FALSE(next.front);
  EXPECT_FALSE(open.inside_solid({0, 0, 1}));
  EXPECT_TRUE(closed.inside_solid({0, 0, 1}));
  EXPECT_FALSE(closed.inside_solid({0, 0, 2.1}));
}

TEST(Shape, InAPeriodicCellIsALargeTiling) {
  Philox random(6);
  Scene cell = test::empty_scene(2, true);
  std::vector<Shape> shapes;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d at(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.3, 0.9));
    for (Shape shape : one_of_each(random, at, 0.25)) shapes.push_back(shape);
  }
  cell.prototypes = {shape_prototype(shapes)};
  cell.instances = {{0, {0.4, -0.7, 0}, Rotation::about_axes(0.3, 0, 0), 1}};
  Scene tiles = cell;
  tiles.domain.periodic = false;
  tiles.domain.size_m.setZero();
  tiles.instances.clear();
  for (int x = -14; x <= 14; ++x)
    for (int y = -14; y <= 14; ++y) {
      tiles.instances.push_back(cell.instances[0]);
      tiles.instances.back().position_m += Eigen::Vector3d(2 * x, 2 * y, 0);
    }
  const Intersector all(tiles);
  for (const IntersectorOptions& options : {flat, instanced}) {
    const Intersector one(cell, options);
    int different = 0, hits = 0;
    constexpr int rays = 20'000;
    for (int k = 0; k < rays; ++k) {
      const double azimuth = random.uniform(0, 2 * pi), zenith = radians(random.uniform(0, 80));
      Eigen::Vector3f d = direction_from_angles(zenith, azimuth, cell.domain).cast<float>();
      if (k % 2) d.z() = -d.z();
      const Eigen::Vector3d o(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0, 1.2));
      const Ray ray{o.cast<float>(), d, 1e30f, {}};
      Hit a, b;
      const Escape x = one.intersect(ray, a), y = all.intersect(ray, b);
      EXPECT_EQ(one.occluded(ray), x == Escape::hit);
      if (x != y || (x == Escape::hit && a.id.primitive != b.id.primitive)) {
        ++different;
        continue;
      }
      if (x != Escape::hit) continue;
      ++hits;
      EXPECT_NEAR(a.distance, b.distance, 1e-4);
      EXPECT_LT((a.geometric_normal - b.geometric_normal).norm(), 1e-3);
      // And on, from what was met.
      Eigen::Vector3f onward = test::random_direction(random);
      if ((onward.dot(a.geometric_normal) > 0) != a.front) onward = -onward;
      Hit c, e;
      const Escape p = one.intersect({a.position, onward, 30, a.id}, c);
      const Escape q = all.intersect({b.position, onward, 30, b.id}, e);
      different += (p == Escape::hit) != (q == Escape::hit);
    }
    EXPECT_LT(different, rays / 1000);  // silhouettes
    EXPECT_GT(hits, rays / 20);
  }
}

TEST(Shape, KeepsParallelRaysAway) {
  const Scene scene = shape_scene({sphere({0, 0, 1}, 0.5)});
  EXPECT_EQ(Intersector(scene).parallel_rays(scene, {0, 0, 1}), nullptr);
}

}  // namespace
}  // namespace bpms
