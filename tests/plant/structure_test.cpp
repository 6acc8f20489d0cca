// Leaf angles and G from triangles against analytic distributions.
#include "plant/structure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "plant/plant_mesh.h"

namespace bpms {
namespace {

std::vector<double> fine_zeniths_deg() {
  std::vector<double> out;
  for (int i = 0; i <= 1800; ++i) out.push_back(i * 0.05);
  return out;
}

double g_identity(const FacetStructure& structure) {
  double sum = 0;  // trapezoid of G sin(theta)
  for (std::size_t i = 0; i + 1 < structure.g_function.size(); ++i) {
    const auto f = [&](std::size_t k) {
      return structure.g_function[k].g * std::sin(radians(structure.g_function[k].zenith_deg));
    };
    sum += (f(i) + f(i + 1)) / 2 *
           radians(structure.g_function[i + 1].zenith_deg - structure.g_function[i].zenith_deg);
  }
  return sum;
}

// A facet sphere posing as a leaf: its normals are spread over all directions evenly.
Mesh sphere_as_leaf() {
  Mesh mesh = plant_mesh(parse_plant("b.bpms", "units m b b { a_radius 0.5 }"), {1e-4});
  mesh.organs[0].kind = "leaf";
  mesh.organs[0].material = "leaf";
  return mesh;
}

TEST(Structure, ProjectionOfOneAngleMatchesTheAverageOverAzimuth) {
  for (const double leaf : {0.0, 0.2, 0.9, 1.4, pi / 2}) {
    for (const double zenith : {0.0, 0.3, 1.0, 1.5, pi / 2}) {
      double sum = 0;
      constexpr int n = 200000;
      for (int i = 0; i < n; ++i)
        sum += std::abs(std::cos(leaf) * std::cos(zenith) +
                        std::sin(leaf) * std::sin(zenith) * std::cos(2 * pi * (i + 0.5) / n));
      EXPECT_NEAR(mean_projection(leaf, zenith), sum / n, 1e-9);
    }
  }
}

TEST(Structure, SphericalLeavesHaveGOfOneHalf) {
  const Mesh mesh = sphere_as_leaf();
  const FacetStructure structure = facet_structure({{&mesh, 1, 1}}, fine_zeniths_deg());
  for (const auto& point : structure.g_function) EXPECT_NEAR(point.g, 0.5, 1e-3) << point.zenith_deg;
  EXPECT_NEAR(structure.mean_leaf_angle_deg, 57.30, 0.1);
  EXPECT_NEAR(structure.mean_cos2, 1.0 / 3, 1e-3);
  ASSERT_EQ(structure.leaf_angle.size(), 18u);
  for (const auto& bin : structure.leaf_angle) {
    EXPECT_NEAR(bin.probability, std::cos(radians(bin.from_deg)) - std::cos(radians(bin.to_deg)), 0.02)
        << bin.from_deg;
  }
}

TEST(Structure, GObeysItsIdentityAndBinsSumAsTheyShould) {
  const Mesh grass = plant_mesh(read_plant(std::string(BPMS_SOURCE_DIR) + "/examples/plants/grass.bpms"));
  const Mesh sphere = sphere_as_leaf();
  for (const Mesh* mesh : {&grass, &sphere}) {
    const FacetStructure structure = facet_structure({{mesh, 1, 1}}, fine_zeniths_deg());
    EXPECT_NEAR(g_identity(structure), 0.5, 1e-5);
    double probability = 0, integral = 0;
    for (const auto& bin : structure.leaf_angle) {
      probability += bin.probability;
      integral += bin.density_per_deg * (bin.to_deg - bin.from_deg);
    }
    EXPECT_NEAR(probability, 1, 1e-12);
    EXPECT_NEAR(integral, 1, 1e-12);
  }
}

TEST(Structure, GOfTrianglesIsTheDirectSum) {
  const Mesh mesh =
      plant_mesh(read_plant(std::string(BPMS_SOURCE_DIR) + "/examples/plants/grass.bpms"), {1e-3});
  for (const double zenith_deg : {0.0, 30.0, 57.5, 85.0}) {
    double projected = 0, area = 0;
    constexpr int azimuths = 3600;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (mesh.organs[mesh.organ_of_triangle[t]].kind != "leaf") continue;
      const auto& [a, b, c] = mesh.triangles[t];
      const Eigen::Vector3d p = mesh.positions_m[a].cast<double>();
      const Eigen::Vector3d n =
          (mesh.positions_m[b].cast<double>() - p).cross(mesh.positions_m[c].cast<double>() - p) / 2;
      for (int i = 0; i < azimuths; ++i) {
        const double phi = 2 * pi * i / azimuths;
        const double theta = radians(zenith_deg);
        projected += std::abs(n.dot(Eigen::Vector3d(std::sin(theta) * std::cos(phi),
                                                    std::sin(theta) * std::sin(phi), std::cos(theta)))) /
                     azimuths;
      }
      area += n.norm();
    }
    const FacetStructure structure = facet_structure({{&mesh, 1, 1}}, {zenith_deg});
    EXPECT_NEAR(structure.g_function[0].g, projected / area, 1e-6) << zenith_deg;
    EXPECT_NEAR(structure.total_leaf_area_m2, area, 1e-12);
  }
}

TEST(Structure, SingleAnglesFallIntoTheirBins) {
  for (const double inclination : {2.0, 42.0, 88.0}) {
    // A straight leaf inclined by this from the vertical has its normal at 90 minus this.
    const Mesh mesh = plant_mesh(parse_plant(
        "l.bpms", fmt::format("units m l l {{ a_length 1 a_width 0.1 a_inclination {} }}", inclination)));
    const FacetStructure structure = facet_structure({{&mesh, 1, 1}}, {0});
    const double angle = 90 - inclination;
    EXPECT_NEAR(structure.mean_leaf_angle_deg, angle, 1e-4);
    for (const auto& bin : structure.leaf_angle)
      EXPECT_NEAR(bin.probability, angle > bin.from_deg && angle < bin.to_deg ? 1 : 0, 1e-9);
    EXPECT_NEAR(structure.g_function[0].g, std::cos(radians(angle)), 1e-3);
    EXPECT_NEAR(structure.height_m, std::cos(radians(inclination)) + 0, 1e-6);
  }
}

TEST(Structure, AreasAreSummedByMaterialWithTheirWeights) {
  const Mesh mesh = plant_mesh(read_plant(std::string(BPMS_SOURCE_DIR) + "/examples/plants/grass.bpms"));
  const FacetStructure one = facet_structure({{&mesh, 1, 1}}, {});
  const FacetStructure many = facet_structure({{&mesh, 2, 1}, {&mesh, 5, 1.5}}, {});
  EXPECT_NEAR(many.total_leaf_area_m2, 7 * one.total_leaf_area_m2, 1e-12);
  EXPECT_NEAR(many.other_area_m2.at("stem"), 7 * one.other_area_m2.at("stem"), 1e-12);
  EXPECT_NEAR(many.height_m, 1.5 * one.height_m, 1e-12);
  EXPECT_NEAR(many.mean_leaf_angle_deg, one.mean_leaf_angle_deg, 1e-9);
  EXPECT_NEAR(one.leaf_area_m2.at("leaf"),
              mesh.organs[1].area_m2 + mesh.organs[2].area_m2 + mesh.organs[4].area_m2, 1e-12);
  EXPECT_TRUE(facet_structure({}, {0}).g_function.empty());
}

}  // namespace
}  // namespace bpms
