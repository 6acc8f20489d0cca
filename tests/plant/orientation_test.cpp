// Leaf angles and G from facets, against tabulated distributions and direct sums.
#include "plant/structure/orientation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/random.h"
#include "core/units.h"
#include "leaf_angles.h"
#include "plant/plant_mesh.h"
#include "plant/structure/mean_projection.h"

namespace bpms {
namespace {

// By Simpson's rule.
double g_identity(const FacetOrientation& facets) {
  constexpr int steps = 3600;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double t = pi / 2 * i / steps;
    sum += (i == 0 || i == steps ? 1 : i % 2 ? 4 : 2) * facets.g(t) * std::sin(t);
  }
  return sum * pi / 2 / steps / 3;
}

Mesh grass() {
  return plant_mesh(read_plant(std::string(BPMS_SOURCE_DIR) + "/examples/plants/grass.bpms"), {1e-3});
}

// A facet spheroid posing as a leaf: its normals are those of the ellipsoidal distribution, chi = width over
// height.
Mesh spheroid_as_leaf(double chi) {
  Mesh mesh = plant_mesh(parse_plant("b.bpms", "units m b b { a_radius 0.5 }"), {1e-4});
  mesh.organs[0].kind = "leaf";
  for (Eigen::Vector3f& p : mesh.positions_m) p.z() = (p.z() - 0.5F) / static_cast<float>(chi);
  return mesh;
}

void expect_row(const FacetOrientation& facets, const test::LeafAngleRow& row, double g_tolerance,
                double angle_tolerance_deg) {
  EXPECT_NEAR(degrees(facets.mean_inclination()), row.mean_deg, angle_tolerance_deg);
  EXPECT_NEAR(degrees(facets.sd_inclination()), row.sd_deg, angle_tolerance_deg);
  EXPECT_NEAR(facets.mean_cos2(), row.mean_cos2, g_tolerance);
  for (int k = 0; k < 8; ++k)
    EXPECT_NEAR(facets.g(radians(test::table_angles_deg[k])), row.g[k], g_tolerance)
        << test::table_angles_deg[k];
}

TEST(MeanProjection, IsTheAverageOverAzimuth) {
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

// 20 000 quantiles: what is left is the rounding of the table (5e-5, 5e-3 degrees) and some 1e-5 of the sum.
TEST(Orientation, OfFacetsAtTheQuantilesIsDeWitsTable) {
  for (const test::DeWitRow& row : test::de_wit_table) {
    SCOPED_TRACE(name_of(row.angles));
    const auto quantile = [&](double u) { return leaf_angle_quantile(row.angles, u); };
    expect_row(test::facets_at_quantiles(quantile, 20000), row.is, 1e-4, 0.011);
  }
}

TEST(Orientation, OfFacetsDrawnAtRandomIsDeWitsTableWithinTheirSpread) {
  constexpr int count = 40000;
  for (const test::DeWitRow& row : test::de_wit_table) {
    SCOPED_TRACE(name_of(row.angles));
    Philox random(11, static_cast<std::uint64_t>(row.angles));
    FacetOrientation facets;
    for (int i = 0; i < count; ++i) {
      const double t = leaf_angle_quantile(row.angles, random.uniform()), a = 2 * pi * random.uniform();
      facets.add({std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t)});
    }
    EXPECT_NEAR(degrees(facets.mean_inclination()), row.is.mean_deg,
                4 * row.is.sd_deg / std::sqrt(count) + 0.005);
    // |n . Omega| and cos^2 lie in [0, 1]: their sd is at most 1/2.
    for (int k = 0; k < 8; ++k) {
      const double zenith = radians(test::table_angles_deg[k]);
      EXPECT_NEAR(facets.g(zenith), row.is.g[k], 4 * 0.5 / std::sqrt(count)) << k;
      EXPECT_NEAR(facets.g(zenith, 0.7), row.is.g[k], 4 * 0.5 / std::sqrt(count)) << k;
    }
  }
}

// The mesh's own facets lie within 1e-4 m of a sphere of 0.5 m: angles of some 1 degree, whose effect on
// averages is of second order.
TEST(Orientation, OfSpheroidMeshesIsTheEllipsoidalTable) {
  for (const test::EllipsoidalRow& row : test::ellipsoidal_table) {
    SCOPED_TRACE(row.chi);
    expect_row(leaf_orientation(spheroid_as_leaf(row.chi)), row.is, 1.5e-3, 0.1);
  }
  expect_row(leaf_orientation(spheroid_as_leaf(1)), test::de_wit_table[5].is, 1e-3, 0.1);
}

TEST(Orientation, ObeysTheIdentityOfGAndBinsSumAsTheyShould) {
  for (const Mesh& mesh : {grass(), spheroid_as_leaf(1), spheroid_as_leaf(0.3)}) {
    const FacetOrientation facets = leaf_orientation(mesh);
    EXPECT_NEAR(g_identity(facets), 0.5, 1e-6);
    for (const auto& bins : {facets.inclination_bins(), facets.azimuth_bins()}) {
      double probability = 0, integral = 0;
      for (const AngleBin& bin : bins) {
        probability += bin.probability;
        integral += bin.density_per_deg * (bin.to_deg - bin.from_deg);
      }
      EXPECT_NEAR(probability, 1, 1e-12);
      EXPECT_NEAR(integral, 1, 1e-12);
    }
  }
}

TEST(Orientation, GivesTheDirectSumsForOneDirectionAndForTheirMean) {
  const Mesh mesh = grass();
  const FacetOrientation facets = leaf_orientation(mesh);
  for (const double zenith : {0.0, 0.5, 1.0036, 1.48}) {
    double mean = 0;
    constexpr int azimuths = 720;
    for (int i = 0; i < azimuths; ++i) {
      const double phi = 2 * pi * i / azimuths;
      const Eigen::Vector3d omega(std::sin(zenith) * std::cos(phi), std::sin(zenith) * std::sin(phi),
                                  std::cos(zenith));
      double projected = 0, area = 0;
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (mesh.organs[mesh.organ_of_triangle[t]].kind != "leaf") continue;
        const Eigen::Vector3d a = triangle_area_vector(mesh, t);
        projected += std::abs(a.dot(omega));
        area += a.norm();
      }
      EXPECT_NEAR(facets.g(zenith, phi), projected / area, 3e-4) << zenith << " " << phi;
      mean += projected / area / azimuths;
    }
    EXPECT_NEAR(facets.g(zenith), mean, 2e-6) << zenith;
  }
}

TEST(Orientation, PutsSingleAnglesIntoTheirBins) {
  for (const double inclination : {2.0, 42.0, 88.0}) {
    // A straight leaf inclined by this from the vertical has its normal at 90 minus this.
    const Mesh mesh = plant_mesh(parse_plant(
        "l.bpms", fmt::format("units m l l {{ a_length 1 a_width 0.1 a_inclination {} }}", inclination)));
    const FacetOrientation facets = leaf_orientation(mesh);
    const double angle = 90 - inclination;
    EXPECT_NEAR(degrees(facets.mean_inclination()), angle, 1e-4);
    for (const AngleBin& bin : facets.inclination_bins())
      EXPECT_NEAR(bin.probability, angle > bin.from_deg && angle < bin.to_deg ? 1 : 0, 1e-9);
    EXPECT_NEAR(facets.g(0), std::cos(radians(angle)), 1e-6);
    // It leans to +x with its lower side down: the upward normal looks to -x.
    for (const AngleBin& bin : facets.azimuth_bins(30))
      EXPECT_NEAR(bin.probability, bin.from_deg <= 180 && bin.to_deg > 180 ? 1 : 0, 1e-9) << bin.from_deg;
  }
}

TEST(Orientation, TurnsWithWhatItIsAddedTo) {
  const FacetOrientation own = leaf_orientation(grass());
  const double by = radians(70);
  FacetOrientation turned, in_space;
  turned.add(own, 3, by);
  in_space.add(own, 3, Eigen::AngleAxisd(by, Eigen::Vector3d::UnitZ()).toRotationMatrix());
  for (const FacetOrientation* of : {&turned, &in_space}) {
    EXPECT_NEAR(of->area(), 3 * own.area(), 1e-12);
    for (const double zenith : {0.3, 0.8, 1.3}) {
      EXPECT_NEAR(of->g(zenith, 1.1 + by), own.g(zenith, 1.1), 3e-4);
      EXPECT_NEAR(of->g(zenith), own.g(zenith), 1e-4);
    }
  }
  // Lying on its side about x: what looked up looks along -y.
  FacetOrientation lying;
  lying.add(own, 1, Eigen::AngleAxisd(pi / 2, Eigen::Vector3d::UnitX()).toRotationMatrix());
  EXPECT_NEAR(lying.g(pi / 2, -pi / 2), own.g(0), 3e-4);
  EXPECT_NEAR(g_identity(lying), 0.5, 1e-6);
}

TEST(Orientation, OfNothingIsEmpty) {
  const FacetOrientation none;
  EXPECT_TRUE(none.empty());
  EXPECT_TRUE(none.inclination_bins().empty());
  EXPECT_TRUE(none.azimuth_bins().empty());
}

}  // namespace
}  // namespace bpms
