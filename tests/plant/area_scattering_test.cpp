// Gamma from facets against its closed forms, its integral and direct sums.
#include "plant/structure/area_scattering.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "leaf_angles.h"
#include "plant/plant_mesh.h"

namespace bpms {
namespace {

Eigen::Vector3d direction_of(double zenith, double azimuth) {
  return {std::sin(zenith) * std::cos(azimuth), std::sin(zenith) * std::sin(azimuth), std::cos(zenith)};
}

constexpr LeafOptics green{0.4, 0.25};

// Facets in 1800 bins and cells of 1 by 2 degrees: the sums of products are off by 1e-4 at most.
TEST(AreaScattering, OfSphericalLeavesIsRosssClosedForm) {
  const auto quantile = [](double u) { return leaf_angle_quantile(LeafAngles::spherical, u); };
  const FacetOrientation facets = test::facets_at_quantiles(quantile, 200000);
  const std::vector<ScatteringLeaves> leaves{{&facets, green}};
  for (const double in : {pi, 2.5, 1.8}) {
    for (const double out : {0.1, 0.9, 1.5, 2.2, 3.0}) {
      for (const double azimuth : {0.0, 1.0, 2.9}) {
        const Eigen::Vector3d a = direction_of(in, 0.3), b = direction_of(out, 0.3 + azimuth);
        const double expected = spherical_area_scattering(green, std::acos(std::clamp(a.dot(b), -1.0, 1.0)));
        EXPECT_NEAR(area_scattering(leaves, a, b), expected, 2e-4);
        EXPECT_NEAR(area_scattering(leaves, in, out, azimuth), expected, 2e-4);
      }
    }
  }
  // Straight back: rho / 3; straight on: tau / 3.
  EXPECT_NEAR(spherical_area_scattering(green, pi), green.reflectance / 3, 1e-12);
  EXPECT_NEAR(spherical_area_scattering(green, 0), green.transmittance / 3, 1e-12);
}

TEST(AreaScattering, OfHorizontalLeavesIsTheirCosines) {
  FacetOrientation flat;
  flat.add({0, 0, 2});
  for (const double out : {0.2, 1.2, 2.0, 3.1}) {
    const double expected = horizontal_area_scattering(green, 2.6, out);
    EXPECT_NEAR(area_scattering({{&flat, green}}, direction_of(2.6, 1), direction_of(out, 4)), expected,
                1e-12);
    EXPECT_NEAR(area_scattering({{&flat, green}}, 2.6, out, 3), expected, 1e-9);
  }
  EXPECT_NEAR(horizontal_area_scattering(green, pi, 0), green.reflectance, 1e-12);
  EXPECT_NEAR(horizontal_area_scattering(green, pi, pi), green.transmittance, 1e-12);
}

TEST(AreaScattering, IntegratesToTheAlbedoTimesG) {
  const Mesh grass =
      plant_mesh(read_plant(std::string(BPMS_SOURCE_DIR) + "/examples/plants/grass.bpms"), {1e-3});
  const FacetOrientation facets = leaf_orientation(grass);
  const Eigen::Vector3d in = direction_of(2.4, 0.7);
  double sum = 0, mean = 0;
  constexpr int rows = 90, columns = 120;
  for (int i = 0; i < rows; ++i) {
    const double cosine = -1 + (i + 0.5) * 2 / rows;
    for (int k = 0; k < columns; ++k) {
      const double azimuth = 2 * pi * (k + 0.5) / columns, weight = 2.0 / rows * 2 * pi / columns / pi;
      sum += weight * area_scattering({{&facets, green}}, in, direction_of(std::acos(cosine), azimuth));
      if (k % 12 == 0)
        mean += 12 * weight * area_scattering({{&facets, green}}, 2.4, std::acos(cosine), azimuth);
    }
  }
  const double albedo = green.reflectance + green.transmittance;
  // The grid of directions resolves the kinks of |n . Omega| to some 1e-3.
  EXPECT_NEAR(sum, albedo * facets.g(pi - 2.4, 0.7 + pi), 1e-3);
  EXPECT_NEAR(mean, albedo * facets.g(pi - 2.4), 2e-3);
}

TEST(AreaScattering, IsTheDirectSumOverTheFacetsOfAMesh) {
  const Mesh grass =
      plant_mesh(read_plant(std::string(BPMS_SOURCE_DIR) + "/examples/plants/grass.bpms"), {1e-3});
  const FacetOrientation facets = leaf_orientation(grass);
  const Eigen::Vector3d in = direction_of(2.8, 2), out = direction_of(0.9, 5);
  double sum = 0, area = 0;
  for (std::size_t t = 0; t < grass.triangles.size(); ++t) {
    if (grass.organs[grass.organ_of_triangle[t]].kind != "leaf") continue;
    const Eigen::Vector3d a = triangle_area_vector(grass, t), n = a.normalized();
    const double product = n.dot(in) * n.dot(out);
    sum += a.norm() * (product < 0 ? -product * green.reflectance : product * green.transmittance);
    area += a.norm();
  }
  EXPECT_NEAR(area_scattering({{&facets, green}}, in, out), sum / area, 3e-4);
}

TEST(AreaScattering, AddsMaterialsByTheirArea) {
  FacetOrientation one, two;
  one.add({0, 0, 1});
  two.add({0, 0, 3});
  const double both = area_scattering({{&one, {0.8, 0}}, {&two, {0.4, 0}}}, {0, 0, -1}, {0, 0, 1});
  EXPECT_NEAR(both, (0.8 + 3 * 0.4) / 4, 1e-12);
}

}  // namespace
}  // namespace bpms
