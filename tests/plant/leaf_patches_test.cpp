// Bezier patches of leaves against the surfaces and the triangles they stand for.
#include "plant/leaf_patches.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "plant/geometry/leaf_surface.h"
#include "plant/plant_mesh.h"

namespace bpms {
namespace {

Plant patched_leaf(const std::string& attributes) {
  return parse_plant("leaf.bpms", "units cm\nl\nl { a_length 10 a_width 3 " + attributes + " }\n");
}

const char* const patched_shapes[] = {
    "",
    "f_inclination n 0 0 1 180 f_curvature n 0 30 1 30",
    "f_inclination p 15 40 30 f_width n 0 0.6 0.3 1 1 0 f_twist f 10 -10 f_curvature n 0 20 1 5",
    "f_inclination s 0 5 0.5 60 1 150 f_azimuth n 0 0 1 60 f_curvature n 0 -40 1 170",
    "section v_fold f_curvature n 0 30 0.5 50 1 10 f_inclination n 0 10 0.4 20 1 100",
    "section raised_midrib a_midrib_width 0.1 a_midrib_height 0.05 f_inclination n 0 0 1 90 f_width p 0.5 1 "
    "-1",
};

TEST(LeafPatches, LieOnTheSurfaceWithinTheTolerance) {
  for (const double tolerance : {1e-4, 1e-5}) {
    for (const char* shape : patched_shapes) {
      const Plant plant = patched_leaf(shape);
      const OrganAttributes& leaf = plant.blocks[0].attributes;
      double covered = 0, worst = 0;
      for (const LeafPatch& patch : leaf_patches(leaf, tolerance)) {
        covered += (patch.l_to - patch.l_from) * (patch.s_to - patch.s_from);
        // Elsewhere than where the fit looked; the same (l, s): each within that of the other.
        for (const double u : {0.0, 0.13, 0.41, 0.77, 1.0}) {
          const LeafRow row = leaf_rows(leaf, {patch.l_from + u * (patch.l_to - patch.l_from)}).front();
          for (const double v : {0.0, 0.11, 0.37, 0.66, 1.0}) {
            const double s = patch.s_from + v * (patch.s_to - patch.s_from);
            const PatchPoint at = patch_point(patch.points, u, v);
            worst = std::max(worst, (at.position - leaf_point_m(row, patch.panel, s)).norm());
            if (row.width_m > 1e-3 && u > 0 && u < 1) {
              EXPECT_GT(at.normal.dot(leaf_normal(row, patch.panel, s)), 0.99) << shape;  // the same face
            }
          }
        }
      }
      EXPECT_NEAR(covered, 2, 1e-12) << shape;     // all of [0, 1] x [-1, 1], once
      EXPECT_LT(worst, 1.1 * tolerance) << shape;  // the largest lies near what was looked at
    }
  }
}

TEST(LeafPatches, HaveTheLeafsArea) {
  for (const char* shape : patched_shapes) {
    const Plant plant = patched_leaf(shape);
    const double area = leaf_surface_area_m2(plant.blocks[0].attributes);
    const Mesh diced = dice_patches(plant_patches(plant, 1e-5), 1e-5);
    double sum = 0;
    for (const Mesh::Organ& organ : diced.organs) sum += organ.area_m2;
    EXPECT_NEAR(sum, area, 1e-3 * area) << shape;  // chords of 1e-5 m
    EXPECT_NEAR(sum, plant_mesh(plant).organs[0].area_m2, 1e-3 * area) << shape;
  }
}

TEST(LeafPatches, ShareTheirEdges) {
  for (const char* shape : patched_shapes) {
    const Plant plant = patched_leaf(shape);
    const std::vector<LeafPatch> patches = leaf_patches(plant.blocks[0].attributes, 1e-4);
    int shared = 0;
    for (const LeafPatch& a : patches) {
      for (const LeafPatch& b : patches) {
        if (a.l_to == b.l_from && a.s_from == b.s_from) {
          ++shared;
          for (std::size_t j = 0; j < 4; ++j)
            EXPECT_LT((a.points[12 + j] - b.points[j]).norm(), 1e-9) << shape;
        }
        if (a.s_to == b.s_from && a.l_from == b.l_from) {
          ++shared;
          for (std::size_t i = 0; i < 4; ++i)
            EXPECT_LT((a.points[4 * i + 3] - b.points[4 * i]).norm(), 1e-9) << shape;
        }
      }
    }
    EXPECT_GE(shared + 1, static_cast<int>(patches.size())) << shape;
  }
}

}  // namespace
}  // namespace bpms
