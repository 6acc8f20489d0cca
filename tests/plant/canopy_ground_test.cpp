// What plants stand on: terrain, ridges, both; upright or along the normal; what is refused.
#include <cmath>

#include "core/units.h"
#include "tests/plant/canopy_files.h"

namespace bpms {
namespace {

using enum ErrorKind;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

double hill(double x, double y) {  // repeats every 8 x 6 m
  return 0.5 * std::sin(2 * pi * x / 8) + 0.3 * std::cos(2 * pi * y / 6);
}

class CanopyGroundTest : public test::CanopyFiles {
 protected:
  const std::string random = "pattern = \"random\"\ndensity_per_m2 = 40\n";
  const std::string dem = "[terrain]\nfile = \"hills.asc\"\nmaterial = \"soil\"\n";
  const std::string soil = "[terrain]\nmaterial = \"soil\"\n";
  void write_hills() { write_grid("hills.asc", 33, 25, 0.25, -4, -3, hill); }
};

TEST_F(CanopyGroundTest, PlantsStandOnTheTriangles) {
  write_hills();
  const Canopy canopy = read("size_m = [8, 6]", random + "depth_m = 0.02", dem);
  ASSERT_TRUE(canopy.ground);
  EXPECT_EQ(canopy.ground->material, "soil");
  EXPECT_THAT(canopy.inputs, Contains(HasSubstr("hills.asc")));
  ASSERT_EQ(canopy.placements.size(), 1920u);
  for (const Placement& p : canopy.placements) {
    const Eigen::Vector3d at = p.position_m;
    EXPECT_DOUBLE_EQ(at.z(), canopy.ground->terrain->height_m(at.head<2>()) - 0.02);
    // Linear interpolation over squares of 0.25 m: off by at most 0.25^2 / 8 (0.31 + 0.33).
    EXPECT_NEAR(at.z() + 0.02, hill(at.x(), at.y()), 0.0051);
    EXPECT_EQ(p.up, Eigen::Vector3f::UnitZ());
  }
}

TEST_F(CanopyGroundTest, PlantsLeanWithAPlane) {
  write_grid("hills.asc", 21, 21, 1, 500'000, 4'000'000,
             [](double x, double y) { return 0.3 * (x - 500'010) - 0.4 * (y - 4'000'010); });
  const std::string keys = "centred = true\noffset_m = [0, 0, 5]\n";
  const Canopy canopy =
      read("size_m = [18, 18]\nboundary = \"open\"", random + "tilt = \"normal\"", dem + keys);
  const Eigen::Vector3d up = Eigen::Vector3d(-0.3, 0.4, 1).normalized();
  for (const Placement& p : canopy.placements) {
    EXPECT_LT((p.up.cast<double>() - up).norm(), 1e-6);
    // Heights of up to 12 m in floats.
    EXPECT_NEAR(p.position_m.z(), 5 + 0.3 * p.position_m.x() - 0.4 * p.position_m.y(), 2e-6);
  }
}

TEST_F(CanopyGroundTest, ListedHeightsAreAboveGroundUnlessAbsolute) {
  write_hills();
  const std::string list = "pattern = \"list\"\npositions = [[1, 1, 0.5], [-2, 2, 0.25]]\n";
  const Canopy above = read("size_m = [8, 6]", list, dem);
  for (const Placement& p : above.placements)
    EXPECT_NEAR(p.position_m.z() - above.ground->terrain->height_m(p.position_m.head<2>()),
                p.position_m.x() > 0 ? 0.5 : 0.25, 1e-12);
  EXPECT_DOUBLE_EQ(read("size_m = [8, 6]", list + "heights = \"absolute\"", dem).placements[0].position_m.z(),
                   0.5);
}

// Row and ridges at any azimuth: distance from the nearest row line modulo the spacing, from the wave vector.
double from_row(const Eigen::Vector2d& xy, double x_m, double y_m, int m, int n) {
  const Eigen::Vector2d wave(m / x_m, n / y_m);
  const double phase = xy.dot(wave) - 0.5;
  return std::abs(phase - std::round(phase)) / wave.norm();
}

TEST_F(CanopyGroundTest, RowsStandOnTheTopsOfTheirRidges) {
  const std::string rows = "pattern = \"rows\"\nrow_spacing_m = 0.5\nspacing_in_row_m = 0.1\n";
  for (const std::string shape : {"cosine", "triangle", "trapezoid"}) {
    SCOPED_TRACE(shape);
    const std::string ridges = "[ridges]\nheight_m = 0.2\nwidth_m = 0.4\nshape = \"" + shape + "\"\n";
    const Canopy top = read("size_m = [2, 3]", rows, soil + ridges);
    for (const Placement& p : top.placements) EXPECT_NEAR(p.position_m.z(), 0.2, 1e-6);
    const Canopy bottom = read("size_m = [2, 3]", rows, soil + ridges + "plants_on = \"furrow\"\n");
    for (const Placement& p : bottom.placements) EXPECT_NEAR(p.position_m.z(), 0, 1e-6);
    ASSERT_FALSE(bottom.placements.empty());
    EXPECT_EQ(top.ground->terrain->size_m(), Eigen::Vector2d(2, 3));
    EXPECT_EQ(top.ground->terrain->edges_differ_by_m(), 0);
    EXPECT_EQ(top.ground->terrain->rows, 2u);  // rows run north: nothing changes along y
  }
}

TEST_F(CanopyGroundTest, RidgesHaveTheirProfile) {
  const std::string rows = "pattern = \"rows\"\nrow_spacing_m = 0.5\nspacing_in_row_m = 0.1\n";
  const auto at = [&](const std::string& profile, double from_top) {
    const Canopy canopy =
        read("size_m = [2, 3]", rows, soil + "[ridges]\nheight_m = 0.2\nresolution_m = 0.001\n" + profile);
    return canopy.ground->terrain->height_m({0.25 + from_top, 0.3});
  };
  // Nodes a millimetre apart: a chord of the cosine is off by at most 0.001^2 / 8 * 0.1 (2 pi / 0.4)^2.
  EXPECT_NEAR(at("shape = \"cosine\"\nwidth_m = 0.4", 0.07), 0.1 * (1 + std::cos(2 * pi * 0.07 / 0.4)), 4e-6);
  EXPECT_NEAR(at("shape = \"cosine\"", 0.125), 0.1, 4e-6);  // as wide as the spacing
  EXPECT_NEAR(at("shape = \"triangle\"\nwidth_m = 0.4", 0.07), 0.2 * (1 - 0.07 / 0.2), 1e-6);
  EXPECT_NEAR(at("shape = \"triangle\"\nwidth_m = 0.4", 0.22), 0, 1e-6);
  EXPECT_NEAR(at("shape = \"trapezoid\"\nwidth_m = 0.4\ntop_m = 0.1", 0.04), 0.2, 1e-6);
  EXPECT_NEAR(at("shape = \"trapezoid\"\nwidth_m = 0.4\ntop_m = 0.1", 0.15), 0.2 / 3, 1e-6);
  EXPECT_NEAR(at("shape = \"triangle\"\nphase = 0.25", 0.125), 0.2, 1e-6);  // shifted by a quarter
}

TEST_F(CanopyGroundTest, ObliqueRidgesSnapWithTheirRows) {
  const Canopy canopy =
      read("size_m = [3, 3]",
           "pattern = \"rows\"\nrow_spacing_m = 0.5\nrow_azimuth_deg = 33\nspacing_in_row_m = 0.1",
           soil + "[ridges]\nheight_m = 0.2\nshape = \"triangle\"\nresolution_m = 0.005\n");
  EXPECT_THAT(canopy.notes, Contains(HasSubstr("rows snapped to the periodic domain")));
  EXPECT_EQ(canopy.ground->terrain->edges_differ_by_m(), 0);
  const double spacing = 1 / std::hypot(5 / 3.0, -3 / 3.0);  // the wave vector (5, -3) / 3 is the nearest
  // The crest lies between nodes: lower by up to half a square's diagonal times the slope.
  const double slope = 0.2 / (spacing / 2);
  for (const Placement& p : canopy.placements) {
    EXPECT_NEAR(from_row(p.position_m.head<2>(), 3, 3, 5, -3), 0, 1e-9);
    EXPECT_LE(p.position_m.z(), 0.2 + 1e-7);
    EXPECT_GE(p.position_m.z(), 0.2 - slope * 0.0036);
  }
  const auto at = [&](double x, double y) { return canopy.ground->terrain->height_m({x, y}); };
  for (int k = 0; k < 50; ++k) {
    const double x = -1.5 + 0.06 * k, y = 1.4 - 0.05 * k;
    const double expected = 0.2 * (1 - 2 * from_row({x, y}, 3, 3, 5, -3) / spacing);
    EXPECT_NEAR(at(x, y), expected, slope * 0.0036);
  }
}

TEST_F(CanopyGroundTest, RidgesAddToTerrain) {
  write_hills();
  const std::string rows = "pattern = \"rows\"\nrow_spacing_m = 0.5\nspacing_in_row_m = 0.1\n";
  const std::string ridges = "[ridges]\nheight_m = 0.2\nshape = \"triangle\"\n";
  const Canopy plain = read("size_m = [8, 6]", rows, dem),
               ridged = read("size_m = [8, 6]", rows, dem + ridges);
  ASSERT_EQ(plain.placements.size(), ridged.placements.size());
  for (std::size_t i = 0; i < plain.placements.size(); ++i)
    EXPECT_NEAR(ridged.placements[i].position_m.z() - plain.placements[i].position_m.z(), 0.2, 1e-6);
  EXPECT_EQ(ridged.ground->terrain->edges_differ_by_m(), 0);
  EXPECT_EQ(ridged.ground->terrain->columns, 32u * 8 + 1);  // 16 nodes a ridge
}

TEST_F(CanopyGroundTest, OpenRidgesCoverTheField) {
  const std::string rows =
      "pattern = \"rows\"\nrow_spacing_m = 0.3\nrow_azimuth_deg = 90\nspacing_in_row_m = 0.1\n";
  const Canopy canopy = read("size_m = [2, 1]\nboundary = \"open\"", rows,
                             soil + "outside_height_m = 0\n[ridges]\nheight_m = 0.1\nshape = \"cosine\"\n");
  const Terrain& terrain = *canopy.ground->terrain;
  EXPECT_TRUE(terrain.covers({-1, -0.5}));
  EXPECT_TRUE(terrain.covers({1, 0.5}));
  EXPECT_EQ(canopy.ground->outside_height_m, 0.0);
  for (const Placement& p : canopy.placements) EXPECT_NEAR(p.position_m.z(), 0.1, 1e-6);
}

TEST_F(CanopyGroundTest, RidgesMayHaveASpacingOfTheirOwn) {
  const Canopy canopy =
      read("size_m = [2, 3]", random,
           soil + "[ridges]\nheight_m = 0.1\nshape = \"cosine\"\nspacing_m = 0.52\nazimuth_deg = 90\n");
  EXPECT_THAT(canopy.notes,
              Contains(HasSubstr("ridges snapped to the periodic domain: spacing 0.52 m became 0.5 m")));
  double low = 1, high = 0;
  for (const Placement& p : canopy.placements) {
    low = std::min(low, p.position_m.z()), high = std::max(high, p.position_m.z());
    const double from_top = std::remainder(p.position_m.y() - 0.25, 0.5);
    // 16 chords a period: off by at most (0.5 / 16)^2 / 8 * 0.05 (2 pi / 0.5)^2.
    EXPECT_NEAR(p.position_m.z(), 0.05 * (1 + std::cos(2 * pi * from_top / 0.5)), 0.00097);
  }
  EXPECT_LT(low, 0.01);
  EXPECT_GT(high, 0.09);
}

TEST_F(CanopyGroundTest, WhatDoesNotFitIsRefusedWithBothSizes) {
  write_hills();
  const auto refused = [&](const std::string& domain, const std::string& more, const char* message,
                           const std::string& planting = "pattern = \"random\"\ndensity_per_m2 = 4\n") {
    SCOPED_TRACE(message);
    BPMS_EXPECT_ERROR(read(domain, planting, more), bad_input, message);
  };
  refused("size_m = [9, 6]", dem, "canopy.toml:10:8: terrain.file: the terrain is 8 x 6 m");
  refused("size_m = [9, 6]\nboundary = \"open\"", dem,
          "expected it to hold the field, 9 x 6 m about the origin");
  refused("size_m = [8, 6]\nboundary = \"open\"", dem + "offset_m = [1, 0, 0]", "spans x -3 to 5");
  refused("size_m = [8, 6]", dem + "outside_height_m = 0", "a periodic domain has no outside");
  refused("size_m = [8, 6]", "[terrain]\nfile = \"hills.asc\"\n", "missing key 'material'");
  refused("size_m = [8, 6]", soil, "expected file, or a table [ridges]");
  refused("size_m = [8, 6]", "[ridges]\nheight_m = 1\nshape = \"cosine\"\n",
          "expected a table [terrain] beside it");
  refused("size_m = [8, 6]", soil + "[ridges]\nheight_m = 1\nshape = \"cosine\"\n",
          "without rows the ridges need spacing_m");
  const std::string own = soil + "[ridges]\nspacing_m = 1\nheight_m = 1\n";
  refused("size_m = [8, 6]", own + "shape = \"cosines\"", "did you mean 'cosine'?");
  refused("size_m = [8, 6]", own + "shape = \"cosine\"\ntop_m = 0.1", "only a trapezoid has a flat top");
  refused("size_m = [8, 6]", own + "shape = \"trapezoid\"\ntop_m = 1", "less than the width at the foot");
  refused("size_m = [8, 6]", own + "shape = \"cosine\"\nwidth_m = 1.2",
          "no more than the ridges' spacing, 1 m");
  refused("size_m = [8, 6]", own + "shape = \"cosine\"\nplants_on = \"ridge\"", "give phase");
  refused("size_m = [8000, 6000]", own + "azimuth_deg = 40\nshape = \"cosine\"",
          "give a coarser resolution_m", "pattern = \"list\"\npositions = [[5, 0]]");
  refused("size_m = [8, 6]\nboundary = \"open\"", dem, "stands beside the terrain",
          "pattern = \"list\"\npositions = [[5, 0]]");
  write_grid("hills.asc", 33, 25, 0.25, -4, -3, [](double x, double) { return 0.01 * x; });
  refused("size_m = [8, 6]", dem, "opposite edges of the terrain differ by up to 0.08 m");
}

}  // namespace
}  // namespace bpms
