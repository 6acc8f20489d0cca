// Volumes, areas and centroids against closed forms, and the triangles' against the organs'.
#include "plant/mesh_mass.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "plant/plant_mesh.h"

namespace bpms {
namespace {

Mesh mesh_of(const std::string& text, double tolerance_m = 1e-5) {
  return plant_mesh(parse_plant("p.bpms", "units cm " + text), {tolerance_m});
}

// Quadrature is exact to this but for rounding.
constexpr double exact = 1e-9;

TEST(OrganMass, OfASphere) {
  const Mesh::Organ bud = mesh_of("b b { a_radius 1.5 }").organs[0];
  EXPECT_NEAR(bud.volume_m3, 4 * pi / 3 * std::pow(0.015, 3), exact * bud.volume_m3);
  EXPECT_NEAR((bud.centroid_m - Eigen::Vector3d(0, 0, 0.015)).norm(), 0, 1e-12);
}

TEST(OrganMass, OfASpheroidStraightOrBent) {
  const double volume = 4 * pi / 3 * 0.03 * 0.004 * 0.004;
  const Mesh::Organ straight = mesh_of("h h { a_length 6 a_radius 0.4 }").organs[0];
  EXPECT_NEAR(straight.volume_m3, volume, exact * volume);
  EXPECT_NEAR((straight.centroid_m - Eigen::Vector3d(0, 0, 0.03)).norm(), 0, 1e-12);
  // Bending keeps the volume (Pappus).
  const Mesh::Organ bent = mesh_of("h h { a_length 6 a_radius 0.4 f_inclination n 0 0 1 80 }").organs[0];
  EXPECT_NEAR(bent.volume_m3, volume, exact * volume);
}

TEST(OrganMass, OfAFrustum) {
  const double r = 0.02, q = 0.01, h = 0.3;
  const Mesh::Organ stem = mesh_of("s s { a_length 30 a_radius 2 f_width n 0 1 1 0.5 }").organs[0];
  EXPECT_NEAR(stem.volume_m3, pi * h / 3 * (r * r + r * q + q * q), exact * stem.volume_m3);
  const double height = h / 4 * (r * r + 2 * r * q + 3 * q * q) / (r * r + r * q + q * q);
  EXPECT_NEAR((stem.centroid_m - Eigen::Vector3d(0, 0, height)).norm(), 0, 1e-12);
  MeshOptions leaves;
  leaves.bodies = false;
  const Plant plant = parse_plant("s.bpms", "units cm s s { a_length 30 a_radius 2 f_width n 0 1 1 0.5 }");
  const double area = pi * (r + q) * std::hypot(h, r - q) + pi * (r * r + q * q);
  EXPECT_NEAR(plant_mesh(plant, leaves).organs[0].area_m2, area, exact * area);
  EXPECT_TRUE(plant_mesh(plant, leaves).triangles.empty());
}

// A quarter of a torus: volume and side area by Pappus, the centroid by its integral: at radius
// (2 sqrt(2) / pi) (R^2 + r^2 / 4) / R from the centre of the ring, half way round.
TEST(OrganMass, OfASectionOfATorus) {
  const double length = 0.3, r = 0.02, ring = length / (pi / 2);
  const std::string text = "s s { a_length 30 a_radius 2 f_inclination n 0 0 1 90 }";
  const Mesh::Organ stem = mesh_of(text).organs[0];
  EXPECT_NEAR(stem.volume_m3, pi * r * r * length, exact * stem.volume_m3);
  const double out = 2 / pi * (ring + r * r / (4 * ring));  // of either coordinate from the ring's centre
  EXPECT_NEAR((stem.centroid_m - Eigen::Vector3d(ring - out, 0, out)).norm(), 0, 1e-10);
  MeshOptions leaves;
  leaves.bodies = false;
  const double area = plant_mesh(parse_plant("s.bpms", "units cm " + text), leaves).organs[0].area_m2;
  EXPECT_NEAR(area, 2 * pi * r * length + 2 * pi * r * r, exact * area);
}

// A ball of twice the stem's radius at its tip, against the union's volume counted by points.
TEST(OrganMass, CountsWhatAJointAndItsStemShareOnce) {
  const Mesh::Organ stem = mesh_of("s s { a_length 10 a_radius 0.5 a_joint 2 }").organs[0];
  const double r = 0.005, ball = 0.01, length = 0.1;
  double volume = 0, moment = 0;  // by slices
  constexpr int slices = 200000;
  const double step = (length + ball) / slices;
  for (int i = 0; i < slices; ++i) {
    const double z = (i + 0.5) * step, below = ball * ball - (z - length) * (z - length);
    const double square = std::max(z < length ? r * r : 0.0, below);
    volume += pi * square * step;
    moment += pi * square * step * z;
  }
  EXPECT_NEAR(stem.volume_m3, volume, 1e-6 * volume);  // slices across a step
  EXPECT_NEAR(stem.centroid_m.z(), moment / volume, 1e-6);
}

TEST(OrganMass, OfAPlanarLeafIsItsAreasCentroid) {
  // A triangle: width falling from 3 to 0 along 9 cm, centroid at a third.
  const Mesh leaf = mesh_of("l l { a_length 9 a_width 3 f_width n 0 1 1 0 }");
  EXPECT_EQ(leaf.organs[0].volume_m3, 0);
  EXPECT_NEAR((leaf.organs[0].centroid_m - Eigen::Vector3d(0, 0, 0.03)).norm(), 0, 1e-6 * 0.09);
  // A half circle of a strip: its centroid is 2 R / pi from the centre, for leaf and triangles alike.
  const Mesh arch = mesh_of("l l { a_length 10 a_width 1 f_inclination n 0 0 1 180 }");
  const double ring = 0.1 / pi;
  EXPECT_NEAR((arch.organs[0].centroid_m - Eigen::Vector3d(ring, 0, 2 * ring / pi)).norm(), 0, 2e-5);
  EXPECT_NEAR((triangle_masses(arch)[0].centroid_m - arch.organs[0].centroid_m).norm(), 0, 1e-9);
}

TEST(OrganMass, OfTrianglesAgreesWithTheOrgansWithinTheirTolerance) {
  const Mesh mesh =
      plant_mesh(read_plant(std::string(BPMS_SOURCE_DIR) + "/examples/plants/grass.bpms"), {1e-5});
  const std::vector<OrganMass> masses = triangle_masses(mesh);
  ASSERT_EQ(masses.size(), mesh.organs.size());
  OrganMass sum;
  for (std::size_t k = 0; k < masses.size(); ++k) {
    const Mesh::Organ& organ = mesh.organs[k];
    EXPECT_NEAR(masses[k].area_m2, organ.area_m2, 1e-9);
    // 1e-5 m off a radius of 2 to 4 mm.
    EXPECT_NEAR(masses[k].volume_m3, organ.volume_m3, 0.01 * organ.volume_m3) << organ.label;
    EXPECT_LT((masses[k].centroid_m - organ.centroid_m).norm(), 1e-4) << organ.label;
    EXPECT_EQ(organ.volume_m3 > 0, organ.kind != "leaf");
    sum.area_m2 += organ.area_m2;
    sum.volume_m3 += organ.volume_m3;
  }
  const OrganMass plant = plant_mass(mesh);
  EXPECT_NEAR(plant.area_m2, sum.area_m2, 1e-12);
  EXPECT_NEAR(plant.volume_m3, sum.volume_m3, 1e-15);
}

}  // namespace
}  // namespace bpms
