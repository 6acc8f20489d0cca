// Overlap between plants: triangles that cross, known fractions, images of a periodic domain, reduction
// within the pattern.
#include "plant/canopy/overlap.h"

#include <cmath>

#include "core/random.h"
#include "core/units.h"
#include "plant/geometry/triangle_crossing.h"
#include "plant/plant_mesh.h"
#include "tests/plant/canopy_files.h"

namespace bpms {
namespace {

using enum ErrorKind;
using testing::Contains;
using testing::HasSubstr;

TEST(TrianglesCross, AreCutByASegmentOfTheOther) {
  const TriangleCorners flat{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0)};
  const auto upright = [](double x, double y, double low, double high) {
    return TriangleCorners{Eigen::Vector3d(x, y, low), Eigen::Vector3d(x, y + 0.1, low),
                           Eigen::Vector3d(x, y, high)};
  };
  EXPECT_TRUE(triangles_cross(flat, upright(0.2, 0.2, -1, 1)));
  EXPECT_TRUE(triangles_cross(upright(0.2, 0.2, -1, 1), flat));
  EXPECT_FALSE(triangles_cross(flat, upright(0.2, 0.2, 0.1, 1)));  // above
  EXPECT_FALSE(triangles_cross(flat, upright(0.8, 0.8, -1, 1)));   // beside
  EXPECT_FALSE(triangles_cross(flat, upright(0.2, 0.2, 0, 1)));    // stands on it
  EXPECT_FALSE(triangles_cross(flat, flat));                       // in one plane
  TriangleCorners moved = flat;
  for (Eigen::Vector3d& p : moved) p.z() += 1e-9;
  EXPECT_FALSE(triangles_cross(flat, moved));
}

// Against the definition: some point of an edge of one lies in the other, by barycentric coordinates.
TEST(TrianglesCross, AgreeWithTheirEdges) {
  Philox random(3);
  const auto any = [&] {
    TriangleCorners out;
    for (Eigen::Vector3d& p : out) p = {random.uniform(), random.uniform(), random.uniform()};
    return out;
  };
  const auto pierced = [](const TriangleCorners& t, const TriangleCorners& by) {
    for (std::size_t k = 0; k < 3; ++k) {
      Eigen::Matrix3d m;
      m << t[1] - t[0], t[2] - t[0], by[k] - by[(k + 1) % 3];
      const Eigen::Vector3d s = m.fullPivLu().solve(by[k] - t[0]);
      if (s.x() > 0 && s.y() > 0 && s.x() + s.y() < 1 && s.z() > 0 && s.z() < 1) return true;
    }
    return false;
  };
  int crossing = 0;
  for (int k = 0; k < 20000; ++k) {
    const TriangleCorners a = any(), b = any();
    const bool expected = pierced(a, b) || pierced(b, a);
    EXPECT_EQ(triangles_cross(a, b), expected);
    crossing += expected;
  }
  EXPECT_GT(crossing, 1000);
}

class OverlapTest : public test::CanopyFiles {
 protected:
  void SetUp() override {
    CanopyFiles::SetUp();
    // A leaf that stands upright in the plane x = 0, 10 cm high and 4 wide; one that leans over it.
    folder.write("upright.bpms", "units cm l l { material leaf a_length 10 a_width 4 }");
    folder.write("flat.bpms", "units cm l l { material leaf a_length 10 a_width 4 a_inclination 90 }");
  }
  std::string list(const std::string& positions) {
    return "pattern = \"list\"\npositions = [" + positions + "]\n";
  }
  std::string fixed(const std::string& file) {
    return "[[plants]]\nfile = \"" + file + "\"\nrotation = { type = \"fixed\", deg = 0 }\n";
  }
  double overlap(const std::string& domain, const std::string& planting, const std::string& plants) {
    const Canopy canopy = read(domain, planting, "[overlap]\n", plants);
    EXPECT_TRUE(canopy.overlap);
    EXPECT_EQ(canopy.overlap->before, canopy.overlap->fraction);
    EXPECT_THAT(canopy.notes,
                Contains(HasSubstr("of the leaf area is on triangles that cross other plants")));
    return canopy.overlap->fraction;
  }
};

// The leaf area of all triangles of a lone leaf that straddle a plane, by the mesh itself.
double straddling_share(const Mesh& mesh, int axis, double at) {
  double cut = 0, all = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    bool above = false, below = false;
    for (const std::uint32_t v : mesh.triangles[t])
      (static_cast<double>(mesh.positions_m[v][axis]) > at ? above : below) = true;
    const double area = triangle_area_m2(mesh, t);
    all += area;
    if (above && below) cut += area;
  }
  return cut / all;
}

TEST_F(OverlapTest, TwoLeavesThatCrossHaveTheShareOfTheTrianglesInTheCut) {
  // Turned by 90 degrees about the vertical through the middle of the other: every triangle that straddles
  // the other's plane is cut, since the other reaches over the same height.
  const Canopy canopy =
      read("size_m = [1, 1]\nboundary = \"open\"", list("[0, 0, 0, 0], [0.002, 0.003, 0.013, 90]"),
           "[overlap]\n", fixed("upright.bpms"));
  const Mesh& mesh = *canopy.plants[0].mesh;
  // The first leaf is cut by the plane y = 0.003, the second, in its own frame, by y = 0.002.
  const double expected = 0.5 * (straddling_share(mesh, 1, 0.003) + straddling_share(mesh, 1, 0.002));
  EXPECT_GT(expected, 0.2);
  EXPECT_LT(canopy.overlap->fraction, expected + 1e-9);
  EXPECT_GT(canopy.overlap->fraction, 0.5 * expected);
}

TEST_F(OverlapTest, ApartThereIsNone) {
  EXPECT_EQ(overlap("size_m = [1, 1]\nboundary = \"open\"",
                    list("[0, 0, 0, 0], [0.03, 0, 0, 0], [0.06, 0, 0, 0]"), fixed("upright.bpms")),
            0);
  EXPECT_EQ(overlap("size_m = [1, 1]\nboundary = \"open\"", list("[0, 0, 0, 0]"), fixed("flat.bpms")), 0);
}

TEST_F(OverlapTest, ImagesCountInAPeriodicDomain) {
  // A leaf lying 10 cm to the east of its base, at a height of 5 cm; the upright one stands 95 cm to the
  // east, that is 5 cm to the west by its image.
  const std::string places = list("[0.46, 0, 0.05, 0], [-0.49, 0, 0, 0]");
  const std::string both = "[[plants]]\nfile = \"flat.bpms\"\n";
  folder.write("s.csv",
               "x_m,y_m,z_m,rotation_deg,plant\n0.46,0,0.05,0,flat.bpms\n-0.49,0,0,0,upright.bpms\n");
  const std::string table = "pattern = \"list\"\ntable = \"s.csv\"\n";
  EXPECT_EQ(overlap("size_m = [1, 1]\nboundary = \"open\"", table, ""), 0);
  const double periodic = overlap("size_m = [1, 1]", table, "");
  EXPECT_GT(periodic, 0);
  folder.write("s.csv", "x_m,y_m,z_m,rotation_deg,plant\n0.46,0,0.05,0,flat.bpms\n0.51,0,0,0,upright.bpms\n");
  EXPECT_DOUBLE_EQ(overlap("size_m = [2, 1]\nboundary = \"open\"", table, ""), periodic);
  // Its own image: an upright leaf crosses a lying one of the same plant a period on.
  folder.write(
      "cross.bpms",
      "units cm [l][l] l 1 { material leaf a_length 10 a_width 4 } l 2 { material leaf a_length 10 a_width 4 "
      "a_inclination 90 }");
  EXPECT_EQ(overlap("size_m = [0.3, 0.3]", list("[0, 0, 0, 0]"), fixed("cross.bpms")), 0);
  folder.write("cross.bpms",
               "units cm [sl][l] s { material stem a_length 3 a_radius 0.1 } l 1 { material leaf a_length 10 "
               "a_width 4 a_inclination 90 } l 2 { material leaf a_length 10 a_width 4 }");
  EXPECT_GT(overlap("size_m = [0.07, 0.3]", list("[0, 0, 0, 0]"), fixed("cross.bpms")), 0);
}

TEST_F(OverlapTest, AgreesWithAllPairsOfTriangles) {
  folder.write("bush.bpms",
               "units cm [s[+l][+l][+l]] s { material stem a_length 6 a_radius 0.2 } + 1 { a_twist 10 } + 2 "
               "{ a_twist 130 } + 3 { "
               "a_twist 250 } l { material leaf a_length 12 a_width 2 f_inclination n 0 40 1 100 }");
  for (const std::string boundary : {"open", "periodic"}) {
    Canopy canopy = read("size_m = [0.5, 0.4]\nboundary = \"" + boundary + "\"",
                         "pattern = \"random\"\ndensity_per_m2 = 55\n", "[overlap]\n",
                         "[[plants]]\nfile = \"bush.bpms\"\nscale = { mean = 1, sd = 0.1 }\n");
    const Mesh& mesh = *canopy.plants[0].mesh;
    std::vector<std::vector<TriangleCorners>> world;
    const int images = boundary == "periodic" ? 1 : 0;
    for (const Placement& p : canopy.placements) {
      world.emplace_back();
      const Eigen::AngleAxisd turn(p.rotation, Eigen::Vector3d::UnitZ());
      for (const auto& triangle : mesh.triangles) {
        TriangleCorners corners;
        for (std::size_t k = 0; k < 3; ++k)
          corners[k] = turn * (p.scale * mesh.positions_m[triangle[k]].cast<double>()) + p.position_m;
        world.back().push_back(corners);
      }
    }
    double crossing = 0, all = 0;
    for (std::size_t i = 0; i < world.size(); ++i) {
      for (std::size_t t = 0; t < world[i].size(); ++t) {
        if (mesh.organs[mesh.organ_of_triangle[t]].kind != "leaf") continue;
        bool crosses = false;
        for (std::size_t j = 0; j < world.size() && !crosses; ++j) {
          for (int x = -images; x <= images; ++x) {
            for (int y = -images; y <= images; ++y) {
              if (j == i && x == 0 && y == 0) continue;
              const Eigen::Vector3d by(0.5 * x, 0.4 * y, 0);
              const double size = 0.1;  // none of the triangles is larger
              for (const TriangleCorners& unmoved : world[j]) {
                if (crosses) break;
                if ((unmoved[0] + by - world[i][t][0]).squaredNorm() > 4 * size * size) continue;
                TriangleCorners other = unmoved;
                for (Eigen::Vector3d& corner : other) corner += by;
                crosses = triangles_cross(world[i][t], other);
              }
            }
          }
        }
        const double area =
            triangle_area_m2(mesh, t) * canopy.placements[i].scale * canopy.placements[i].scale;
        all += area;
        if (crosses) crossing += area;
      }
    }
    EXPECT_GT(crossing / all, 0.01) << boundary;
    EXPECT_NEAR(canopy.overlap->fraction, crossing / all, 1e-6) << boundary;  // float areas
  }
}

class ReducedOverlap : public OverlapTest {
 protected:
  void SetUp() override {
    OverlapTest::SetUp();
    folder.write("bush.bpms",
                 "units cm [s[+l][+l]] s { material stem a_length 6 a_radius 0.2 } + 1 { a_twist 10 } + 2 { "
                 "a_twist 190 } l { "
                 "material leaf a_length 12 a_width 2 f_inclination n 0 40 1 100 }");
  }
  Canopy stand(const std::string& planting, const std::string& overlap, const std::string& more = "") {
    return read("size_m = [1, 1]\nseed = 3\n", planting, "[overlap]\n" + overlap + more,
                "[[plants]]\nfile = \"bush.bpms\"\n");
  }
};

TEST_F(ReducedOverlap, RotationsAloneKeepThePlaces) {
  const std::string rows = "pattern = \"rows\"\nrow_spacing_m = 0.2\nspacing_in_row_m = 0.1\n";
  const Canopy before = stand(rows, ""), after = stand(rows, "at_most = 0.0\ntries = 12");
  EXPECT_DOUBLE_EQ(after.overlap->before, before.overlap->fraction);
  EXPECT_GT(before.overlap->fraction, 0.01);
  EXPECT_LT(after.overlap->fraction, 0.5 * before.overlap->fraction);
  EXPECT_GT(after.overlap->moved, 0u);
  std::size_t turned = 0;
  for (std::size_t i = 0; i < before.placements.size(); ++i) {
    EXPECT_EQ(after.placements[i].position_m, before.placements[i].position_m);
    turned += after.placements[i].rotation != before.placements[i].rotation;
  }
  EXPECT_EQ(turned, after.overlap->moved);
  // What is reported is what is there.
  PlantCrossings crossings(after);
  double own = 0;
  for (const double area : crossings.own_m2()) own += area;
  EXPECT_DOUBLE_EQ(own / crossings.leaf_area_m2(), after.overlap->fraction);
  EXPECT_THAT(after.notes,
              Contains(HasSubstr(fmt::format("{:.4g} before {} of 50 plants were turned or moved",
                                             after.overlap->before, after.overlap->moved))));
  // The same seed, the same canopy; what is satisfied at once is left as it was.
  const Canopy again = stand(rows, "at_most = 0.0\ntries = 12"), content = stand(rows, "at_most = 0.9");
  for (std::size_t i = 0; i < after.placements.size(); ++i) {
    EXPECT_EQ(after.placements[i].rotation, again.placements[i].rotation);
    EXPECT_EQ(content.placements[i].rotation, before.placements[i].rotation);
  }
}

TEST_F(ReducedOverlap, PlacesStayInTheirPattern) {
  const std::string band =
      "pattern = \"rows\"\nrow_spacing_m = 0.25\nrow_width_m = 0.06\nspacing_in_row_m = { mean = 0.07, sd = "
      "0.01 }\ndepth_m = 0.01\n";
  const std::string ground =
      "\n[terrain]\nmaterial = \"soil\"\n[ridges]\nheight_m = 0.05\nshape = \"cosine\"\n";
  const Canopy rows = stand(band, "at_most = 0.0\ntries = 30", ground);
  EXPECT_LT(rows.overlap->fraction, 0.5 * rows.overlap->before);
  for (const Placement& p : rows.placements) {
    EXPECT_LE(std::abs(std::remainder(p.position_m.x() - 0.125, 0.25)), 0.03 + 1e-9);
    EXPECT_NEAR(p.position_m.z(), rows.ground->terrain->height_m(p.position_m.head<2>()) - 0.01, 1e-9);
  }
  const std::string hard = "pattern = \"hard_core\"\ndensity_per_m2 = 60\nmin_distance_m = 0.06\n";
  const Canopy first = stand(hard, ""), core = stand(hard, "at_most = 0.0\ntries = 2");
  EXPECT_LT(core.overlap->fraction, core.overlap->before);
  std::size_t elsewhere = 0;
  for (std::size_t i = 0; i < core.placements.size(); ++i) {
    elsewhere += core.placements[i].position_m != first.placements[i].position_m;
    for (std::size_t j = 0; j < i; ++j) {
      const Eigen::Vector3d d = core.placements[i].position_m - core.placements[j].position_m;
      EXPECT_GE(std::hypot(std::remainder(d.x(), 1.0), std::remainder(d.y(), 1.0)), 0.06);
    }
  }
  EXPECT_GT(elsewhere, 0u);
}

TEST_F(ReducedOverlap, StopsAtWhatWasAskedOrSaysThatItDidNot) {
  const std::string random = "pattern = \"random\"\ndensity_per_m2 = 60\n";
  const Canopy enough = stand(random, "at_most = 0.02\ntries = 60");
  EXPECT_GT(enough.overlap->before, 0.02);
  EXPECT_LE(enough.overlap->fraction, 0.02);
  const Canopy given = read("size_m = [1, 1]", list("[0, 0, 0, 0], [0.002, 0.003, 0, 90]"),
                            "[overlap]\nat_most = 0.01\n", fixed("upright.bpms"));
  EXPECT_EQ(given.overlap->moved, 0u);  // a list fixes place and rotation
  EXPECT_THAT(given.notes, Contains(HasSubstr("0.01 was asked for")));
  BPMS_EXPECT_ERROR(stand(random, "at_most = 2"), bad_input,
                    "overlap.at_most: found 2, expected a number from 0 to 1");
  BPMS_EXPECT_ERROR(stand(random, "tries = 2"), bad_input, "nothing is tried without at_most");
  BPMS_EXPECT_ERROR(stand(random, "atmost = 0.1"), bad_input, "did you mean 'at_most'?");
}

}  // namespace
}  // namespace bpms
