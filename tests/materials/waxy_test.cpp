// Leaves with a shiny surface: Fresnel, facets, and what is scattered beneath.
#include <tuple>

#include "simulate/materials/dielectric_surface.h"
#include "simulate/materials/rough_specular.h"
#include "tests/materials/lobe_checks.h"

namespace bpms::test {
namespace {

const std::string leaf = "type = \"waxy_leaf\"\nreflectance = 0.3\ntransmittance = 0.2\n";
const std::string ggx = "roughness = 0.3\n", beckmann = "roughness = 0.3\nslopes = \"beckmann\"\n";
const std::string constant = "refractive_index = 1.45\n",
                  spectral = "refractive_index = [[600, 1.35], [700, 1.6]]\n";

TEST(Fresnel, HasItsClosedForms) {
  EXPECT_NEAR(fresnel_reflectance(1, 1.5), 0.04, 1e-15);
  EXPECT_NEAR(fresnel_reflectance(0, 1.5), 1, 1e-15);
  EXPECT_EQ(fresnel_reflectance(0.3, 1), 0);
  // At Brewster's angle one polarisation is gone; the other is cos^2 of twice the angle.
  const double brewster = std::atan(1.5);
  EXPECT_NEAR(fresnel_reflectance(std::cos(brewster), 1.5), std::pow(std::cos(2 * brewster), 2) / 2, 1e-14);
}

TEST(Fresnel, MeanOverAConeIsTheIntegral) {
  for (const double n : {1.0, 1.05, 1.27, 1.5, 2.0}) {
    for (const double cone : {radians(1.0), radians(40.0), radians(75.0), pi / 2}) {
      const double edge = std::pow(std::sin(cone), 2);
      double sum = 0;
      constexpr int steps = 200'000;  // uniform in sine squared
      for (int i = 0; i < steps; ++i)
        sum += 1 - fresnel_reflectance(std::sqrt(1 - edge * (i + 0.5) / steps), n);
      // The midpoint rule at the horizon's square root, and the cancelling terms of the closed form.
      EXPECT_NEAR(cone_transmittance(cone, n), sum / steps, cone < 0.1 ? 1e-6 : 1e-7) << n << " " << cone;
    }
  }
}

TEST(WaxyLeaf, ShinesStraightBackAsFacetsThatAreLevel) {
  const Material waxy = material_of(leaf + constant + ggx);
  const SurfaceLobe& lobe = waxy.lobes.at(0);
  const double straight = std::pow(0.45 / 2.45, 2);
  EXPECT_NEAR(values_of(lobe, direction(0, 0), direction(0, 0), 1)[0], straight / (4 * pi * 0.09), 1e-6);
  EXPECT_TRUE(lobe.lobe->separable());
  EXPECT_FALSE(material_of(leaf + spectral + ggx, {600, 700}).lobes.at(0).lobe->separable());
}

// The area of facets that face a direction, seen along it: Smith's masking follows from it alone, 1 + Lambda
// = area / cosine. Facets' density over h, by slopes.
double facets_of(bool gaussian, double alpha, double cosine) {
  const double tangent2 = (1 / (cosine * cosine) - 1) / (alpha * alpha), c4 = std::pow(cosine, 4);
  return (gaussian ? std::exp(-tangent2) : 1 / ((1 + tangent2) * (1 + tangent2))) / (pi * alpha * alpha * c4);
}
double one_plus_lambda(bool gaussian, double alpha, double zenith) {
  double sum = 0;
  constexpr int n = 1500;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const double h = pi / 2 * (i + 0.5) / n, azimuth = pi * (k + 0.5) / n;
      const double facing =
          std::sin(zenith) * std::sin(h) * std::cos(azimuth) + std::cos(zenith) * std::cos(h);
      if (facing > 0)
        sum += facets_of(gaussian, alpha, std::cos(h)) * facing * std::sin(h) * pi * pi / (n * n);
    }
  return sum / std::cos(zenith);
}

TEST(WaxyLeaf, MasksItsFacetsAsSmithSays) {
  constexpr double alpha = 0.4;
  for (const bool gaussian : {false, true}) {
    const RoughSpecular shine(gaussian ? FacetSlopes::beckmann : FacetSlopes::ggx, alpha, {1.5}, true);
    for (const auto& [view_deg, light_deg, azimuth_deg] :
         {std::tuple{0.0, 40.0, 0.0}, {30.0, 60.0, 180.0}, {70.0, 80.0, 150.0}, {75.0, 20.0, 60.0}}) {
      const Eigen::Vector3d view = direction(view_deg, 0).cast<double>(),
                            light = direction(light_deg, azimuth_deg).cast<double>();
      const Eigen::Vector3d h = (view + light).normalized();
      const double seen = 1 / (one_plus_lambda(gaussian, alpha, radians(view_deg)) +
                               one_plus_lambda(gaussian, alpha, radians(light_deg)) - 1);
      const double expected = fresnel_reflectance(view.dot(h), 1.5) * facets_of(gaussian, alpha, h.z()) *
                              seen / (4 * view.z() * light.z());
      // The integral's midpoints, at the edge of what faces the view.
      EXPECT_NEAR(shine.shape(view.cast<float>(), light.cast<float>()), expected, 2e-4 * expected)
          << view_deg << " " << light_deg;
    }
  }
}

TEST(WaxyLeaf, IsAlmostAMirrorWhereItIsAlmostSmooth) {
  for (const char* slopes : {"ggx", "beckmann"}) {
    const Material waxy = material_of(leaf + constant + "roughness = 0.02\nslopes = \"" + slopes + "\"");
    for (const double zenith : {0.0, 30.0, 60.0}) {
      const double fresnel = fresnel_reflectance(std::cos(radians(zenith)), 1.45);
      // What the facets' tilts, some 2 %, change in F and hide.
      EXPECT_NEAR(directional_albedo(waxy.lobes[0], direction(zenith, 0), 1)[0], fresnel, 0.01 * fresnel);
    }
  }
}

TEST(WaxyLeaf, DrawsWhatItSays) {
  for (const std::string& index : {constant, spectral}) {
    for (const std::string& facets : {ggx, beckmann, std::string("roughness = 0.1\n")}) {
      const Material waxy = material_of(leaf + index + facets, {600, 700});
      ASSERT_EQ(waxy.lobes.size(), 5u);  // shine; reflection and transmission of both faces
      const std::string what = "waxy leaf " + index + facets;
      // F of steep facets is above the mean, and at 75 degrees a third of the draws goes below the horizon.
      check_lobe(what, waxy.lobes[0], 2, {.largest_weight = 5});
      check_lobe(what + " reflected", waxy.lobes[1], 2, {.largest_weight = 1.3});
      check_lobe(what + " transmitted", waxy.lobes[2], 2, {.largest_weight = 1.3});
    }
  }
}

// The sum over all lobes, as the transport meets them.
double albedo_of(const Material& material, std::size_t face, double zenith_deg, std::size_t band) {
  double sum = material.reflectance[face][band] + material.transmittance[band];
  for (const SurfaceLobe& lobe : material.lobes)
    if (lobe.on_face[face])
      sum += directional_albedo(lobe, direction(zenith_deg, 10), material.transmittance.size())[band];
  return sum;
}

TEST(WaxyLeaf, LosesNothingWhereNothingIsAbsorbed) {
  const std::string white = "type = \"waxy_leaf\"\nreflectance = 0.6\ntransmittance = 0.4\n";
  for (const std::string& index : {constant, spectral}) {
    for (const std::string& facets : {ggx, beckmann}) {
      const Material waxy = material_of(white + index + facets, {600, 700});
      for (const double zenith : {0.0, 25.0, 50.0, 70.0, 80.0})
        for (std::size_t band = 0; band < 2; ++band)
          // 1e-3: the grids of both integrals, and the table's straight pieces.
          EXPECT_NEAR(albedo_of(waxy, 0, zenith, band), 1, 1e-3) << facets << index << zenith;
    }
  }
}

TEST(WaxyLeaf, OfOneFaceKeepsTheOtherAndReciprocity) {
  const Material waxy =
      material_of(leaf + "reflectance_back = 0.35\nface = \"front\"\n" + spectral + ggx, {600, 700});
  EXPECT_EQ(waxy.reflectance[0][0], 0);
  EXPECT_EQ(waxy.reflectance[1][0], 0.35);
  std::vector<const SurfaceLobe*> through;
  for (const SurfaceLobe& lobe : waxy.lobes)
    if (lobe.lobe->shape(direction(0, 0), -direction(0, 0)) > 0) through.push_back(&lobe);
  ASSERT_EQ(through.size(), 2u);
  EXPECT_NE(through[0]->on_face[0], through[1]->on_face[0]);
  const Eigen::Vector3f above = direction(70, 0), below(0.3f, 0.4f, -std::sqrt(0.75f));
  const auto turned = [](const Eigen::Vector3f& d) { return Eigen::Vector3f(d.x(), -d.y(), -d.z()); };
  const std::vector<double> one = values_of(*through[0], above, below, 2),
                            other = values_of(*through[1], turned(below), turned(above), 2);
  for (std::size_t band = 0; band < 2; ++band) EXPECT_NEAR(one[band], other[band], 1e-7);
  EXPECT_NE(one[0], values_of(*through[0], turned(below), turned(above), 2)[0]);
  for (const double zenith : {0.0, 60.0, 80.0}) EXPECT_LT(albedo_of(waxy, 1, zenith, 0), 0.35 + 0.2 + 1e-4);
}

TEST(WaxyLeaf, BesideLambertsLawIsRefusedWhereItGivesOutTooMuch) {
  const std::string bright =
      "type = \"waxy_leaf\"\ndiffuse = \"lambertian\"\nreflectance = 0.45\ntransmittance = 0.45\n";
  BPMS_EXPECT_ERROR(material_of(bright + constant + ggx), ErrorKind::bad_input, "for light at 85 degrees");
  const Material dark = material_of(leaf + "diffuse = \"lambertian\"\n" + constant + ggx);
  EXPECT_EQ(dark.lobes.size(), 1u);
  EXPECT_EQ(dark.reflectance[0][0], 0.3);
  BPMS_EXPECT_ERROR(
      material_of("type = \"waxy_leaf\"\nreflectance = 0.6\ntransmittance = 0.45\n" + constant + ggx),
      ErrorKind::bad_input, "expected a sum of at most 1");
}

TEST(WaxyLeaf, OutsideItsParametersIsRefused) {
  struct Case {
    std::string body;
    const char* message;
  };
  const Case cases[] = {
      {leaf + constant, "roughness"},
      {leaf + constant + "roughness = 0.001", "roughness"},
      {leaf + "refractive_index = 0.9\n" + ggx, "refractive_index is 0.9"},
      {leaf + ggx, "refractive_index"},
      {leaf + constant + "roughness = 0.2\nslopes = \"phong\"", "beckmann"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.body);
    BPMS_EXPECT_ERROR(material_of(c.body), ErrorKind::bad_input, c.message);
  }
}

}  // namespace
}  // namespace bpms::test
