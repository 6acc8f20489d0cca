// Patches against surfaces that they are exactly, dicing against the patch, and edges without cracks.
#include "plant/geometry/bezier.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "core/error.h"
#include "scene/importers/patch_file.h"
#include "scene/intersect/intersector.h"
#include "tests/data.h"
#include "tests/scene/shapes.h"

namespace bpms {
namespace {

// z = x^2 + y^2 over [x0, x0 + w] x [y0, y0 + w], exactly: a quadratic raised to a cubic in each direction
// has the blossom's values as control points.
BezierPatch paraboloid(double x0, double y0, double w) {
  BezierPatch out;
  const auto square = [](double a, double b, int k) {  // control points of t^2 between a and b
    return k == 0 ? a * a : k == 1 ? (a * a + 2 * a * b) / 3 : k == 2 ? (2 * a * b + b * b) / 3 : b * b;
  };
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      out[static_cast<std::size_t>(4 * i + j)] = {x0 + w * i / 3, y0 + w * j / 3,
                                                  square(x0, x0 + w, i) + square(y0, y0 + w, j)};
  return out;
}

// (u, v) -> (u, v, h u v): a saddle with four straight edges.
BezierPatch bilinear(double h) {
  BezierPatch out;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      out[static_cast<std::size_t>(4 * i + j)] = {i / 3.0, j / 3.0, h * i * j / 9.0};
  return out;
}

BezierPatch random_patch(Philox& random) {
  BezierPatch out;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      out[static_cast<std::size_t>(4 * i + j)] =
          Eigen::Vector3d(i, j, 0) / 3 +
          0.4 * Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  return out;
}

double area(const Mesh& mesh) {
  double out = 0;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) out += triangle_area_m2(mesh, k);
  return out;
}

// The integral of sqrt(1 + f(x, y)) over the unit square by the midpoint rule, good to 1e-7 here.
template <class F>
double graph_area(const F& slopes2) {
  constexpr int n = 1000;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) sum += std::sqrt(1 + slopes2((i + 0.5) / n, (j + 0.5) / n));
  return sum / n / n;
}

TEST(Bezier, IsTheParaboloidExactly) {
  Philox random(1);
  const BezierPatch patch = paraboloid(-0.3, 0.2, 1.1);
  for (int k = 0; k < 200; ++k) {
    const double u = random.uniform(), v = random.uniform();
    const PatchPoint p = patch_point(patch, u, v);
    EXPECT_NEAR(p.position.z(), p.position.head<2>().squaredNorm(), 1e-14);
    EXPECT_NEAR(p.position.x(), -0.3 + 1.1 * u, 1e-14);
    const Eigen::Vector3d n = Eigen::Vector3d(-2 * p.position.x(), -2 * p.position.y(), 1).normalized();
    EXPECT_LT((p.normal - n).norm(), 1e-13);
  }
}

// Every point of every triangle, against the patch at the same (U,V).
TEST(Bezier, StaysWithinItsTolerance) {
  Philox random(2);
  std::vector<BezierPatch> patches{paraboloid(0, 0, 1), bilinear(1)};
  for (int k = 0; k < 10; ++k) patches.push_back(random_patch(random));
  for (const BezierPatch& patch : patches) {
    for (const double tolerance : {1e-2, 1e-3}) {
      const Mesh mesh = dice_patches({patch}, tolerance);
      double worst = 0;
      for (const auto& [a, b, c] : mesh.triangles) {
        for (int k = 0; k < 6; ++k) {
          double s = random.uniform(), t = random.uniform();
          if (s + t > 1) s = 1 - s, t = 1 - t;
          const auto mix = [&](const auto& of) {
            return ((1 - s - t) * of[a].template cast<double>() + s * of[b].template cast<double>() +
                    t * of[c].template cast<double>())
                .eval();
          };
          const Eigen::Vector2d uv = mix(mesh.uv);
          worst =
              std::max(worst, (mix(mesh.positions_m) - patch_point(patch, uv.x(), uv.y()).position).norm());
        }
      }
      EXPECT_LT(worst, tolerance);
      EXPECT_GT(worst, tolerance / 20);  // and no finer than it need be
    }
  }
}

TEST(Bezier, HasAreasThatConverge) {
  const double bowl = graph_area([](double x, double y) { return 4 * (x * x + y * y); });
  const double saddle = graph_area([](double x, double y) { return x * x + y * y; });
  double last_bowl = 1, last_saddle = 1;
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    const double of_bowl = std::abs(area(dice_patches({paraboloid(0, 0, 1)}, tolerance)) - bowl);
    const double of_saddle = std::abs(area(dice_patches({bilinear(1)}, tolerance)) - saddle);
    EXPECT_LT(of_bowl, 3 * tolerance);  // both go with the square of the steps
    EXPECT_LT(of_saddle, 3 * tolerance);
    EXPECT_LT(of_bowl, 0.3 * last_bowl);
    EXPECT_LT(of_saddle, 0.3 * last_saddle);
    last_bowl = of_bowl, last_saddle = of_saddle;
  }
}

BezierPatch transposed(const BezierPatch& p) {
  BezierPatch out;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) out[4 * i + j] = p[4 * j + i];
  return out;
}
BezierPatch turned_over(const BezierPatch& p) {  // both directions run backwards
  BezierPatch out = p;
  std::reverse(out.begin(), out.end());
  return out;
}

// Edges that only one triangle has, by their ends' places: what is left is the outline.
std::size_t open_edges(const Mesh& mesh) {
  using Place = std::array<float, 3>;
  std::map<std::pair<Place, Place>, int> uses;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3f &a = mesh.positions_m[t[k]], &b = mesh.positions_m[t[(k + 1) % 3]];
      Place x{a.x(), a.y(), a.z()}, y{b.x(), b.y(), b.z()};
      if (y < x) std::swap(x, y);
      ++uses[{x, y}];
    }
  }
  std::size_t out = 0;
  for (const auto& [edge, count] : uses) out += count == 1;
  return out;
}

TEST(Bezier, MeetsItsNeighbourWithoutACrack) {
  // Two patches with one edge curve in common and nothing else alike, in every way they can run along it.
  Philox random(3);
  for (int k = 0; k < 10; ++k) {
    const BezierPatch first = random_patch(random);
    BezierPatch second = random_patch(random);
    for (std::size_t j = 0; j < 4; ++j) {
      second[j] = first[12 + j];
      for (std::size_t i = 1; i < 4; ++i) second[4 * i + j] += Eigen::Vector3d(1, 0, 0);
    }
    const std::size_t apart =
        open_edges(dice_patches({first}, 1e-3)) + open_edges(dice_patches({second}, 1e-3));
    std::size_t in_common = 0;
    for (const BezierPatch& way :
         {second, transposed(second), turned_over(second), transposed(turned_over(second))}) {
      const std::size_t together = open_edges(dice_patches({first, way}, 1e-3));
      ASSERT_LT(together, apart);
      const std::size_t shared = (apart - together) / 2;
      if (in_common == 0) in_common = shared;
      EXPECT_EQ(shared, in_common);
      EXPECT_GT(shared, 5u);
    }
    // All the pieces of the edge are shared: the first patch alone has as many along it.
    std::size_t along = 0;
    const Mesh mesh = dice_patches({first}, 1e-3);
    for (const Eigen::Vector2f& uv : mesh.uv) along += uv.x() == 1;
    EXPECT_EQ(in_common, along - 1);
  }
}

TEST(Bezier, TakesPinchedEdges) {
  // The lid of a pot: one edge is a point. No triangle without an area, no normal that is not one.
  BezierPatch lid = paraboloid(0, 0, 1);
  for (std::size_t j = 0; j < 4; ++j) lid[j] = {0, 0.5, 0};
  const Mesh mesh = dice_patches({lid}, 1e-3);
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) EXPECT_GT(triangle_area_m2(mesh, k), 0);
  for (const Eigen::Vector3f& n : mesh.normals) {
    EXPECT_NEAR(n.norm(), 1, 1e-5);
    EXPECT_GT(n.z(), 0);
  }
  BPMS_EXPECT_ERROR(dice_patches({lid}, 1e-12), ErrorKind::bad_input,
                    "patch 1 would be cut into more than 1024");
}

TEST(Bezier, IsTracedAsTheParaboloid) {
  constexpr double tolerance = 1e-4;
  Scene scene = test::empty_scene(0, false);
  scene.prototypes = {test::mesh_prototype(std::make_shared<Mesh>(dice_patches(
      {paraboloid(-1, -1, 1), paraboloid(0, -1, 1), paraboloid(-1, 0, 1), paraboloid(0, 0, 1)}, tolerance)))};
  scene.instances.emplace_back();
  const Intersector intersector(scene);
  Philox random(4);
  for (int k = 0; k < 5000; ++k) {
    const Eigen::Vector3f o(static_cast<float>(random.uniform(-0.999, 0.999)),
                            static_cast<float>(random.uniform(-0.999, 0.999)), 5);
    Hit hit;
    ASSERT_EQ(intersector.intersect({o, {0, 0, -1}, 1e30f, {}}, hit), Escape::hit);
    EXPECT_TRUE(hit.front);
    const Eigen::Vector3d p = hit.position.cast<double>();
    // The tolerance is between points of equal (U,V): here the same x and y.
    EXPECT_NEAR(p.z(), p.head<2>().squaredNorm(), tolerance + 1e-6);
    const Eigen::Vector3d n = Eigen::Vector3d(-2 * p.x(), -2 * p.y(), 1).normalized();
    EXPECT_LT((hit.shading_normal.cast<double>() - n).norm(), 2e-3);  // between steps of some 1/50
    // (U,V) are x and y within a patch: tangents of unit length in plan.
    EXPECT_NEAR(hit.dp_du.x(), 1, 1e-3);
    EXPECT_NEAR(hit.dp_dv.y(), 1, 1e-3);
    EXPECT_NEAR(hit.dp_du.dot(hit.geometric_normal), 0, 1e-3);
    EXPECT_NEAR(hit.uv.x(), p.x() - std::floor(p.x()), 1e-4);
  }
}

TEST(PatchFile, TakesBothLayouts) {
  std::string points;
  for (const Eigen::Vector3d& p : bilinear(1)) points += fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
  const auto newell = parse_patches("x.bpt", "2\n3 3\n" + points + "3 3\n" + points, 0.01);
  ASSERT_EQ(newell.size(), 2u);
  EXPECT_NEAR(newell[1][15].z(), 0.01, 1e-12);
  const auto plain = parse_patches("x.bpt", "# a patch\n" + points, 1);
  ASSERT_EQ(plain.size(), 1u);
  EXPECT_NEAR(plain[0][4].x(), 1 / 3.0, 1e-6);
  BPMS_EXPECT_ERROR(parse_patches("x.bpt", "2\n3 3\n" + points), ErrorKind::bad_input,
                    "1 patches, the first line");
  BPMS_EXPECT_ERROR(parse_patches("x.bpt", "1\n3 2\n" + points), ErrorKind::bad_input,
                    "x.bpt:2:3: expected the degrees");
  BPMS_EXPECT_ERROR(parse_patches("x.bpt", "1\n3 3\n" + points + "1"), ErrorKind::bad_input,
                    "more than the 1");
  BPMS_EXPECT_ERROR(parse_patches("x.bpt", points + "1 2 3\n"), ErrorKind::bad_input,
                    "the patch that begins in line 17 has fewer than 16 points");
  BPMS_EXPECT_ERROR(parse_patches("x.bpt", "0\n"), ErrorKind::bad_input, "expected the number of patches");
  BPMS_EXPECT_ERROR(parse_patches("x.bpt", "1 2 x\n"), ErrorKind::bad_input, "x.bpt:1:5");
}

}  // namespace
}  // namespace bpms
