// What the reader of scene.toml refuses, and where it says so.
#include <gmock/gmock.h>

#include "tests/simulate/scene_text.h"

namespace bpms::test {
namespace {

struct Text {
  std::string leaf = "type = \"bilambertian\"\nreflectance = 0.4\ntransmittance = 0.3\n";
  std::string sun = "sun = { zenith_deg = 30.0, azimuth_deg = 0.0, irradiance = \"brf\" }";
  std::string bands = "[bands]\nwavelengths_nm = [650, 850]\n";
  std::string sampling = "samples = 64\n";
  std::string str() const {
    return "[domain]\nsize_m = [1, 1]\n[materials.leaf]\n" + leaf +
           "[ground]\ntype = \"plane\"\nmaterial = \"leaf\"\n[illumination]\n" + sun +
           "\n[[sensors]]\nname = \"n\"\ntype = \"brf\"\nviews = [[0, 0]]\n" + bands + "[sampling]\n" +
           sampling;
  }
};

TEST(Input, SpectraAreInterpolatedToTheBands) {
  const TemporaryFolder folder;
  folder.write("tau.csv", "nm,tau\n400,0.0\n900,0.5\n");
  Text text;
  text.leaf =
      "type = \"bilambertian\"\nreflectance = [[600, 0.1], [700, 0.2], [900, 0.4]]\ntransmittance = "
      "\"tau.csv\"\n";
  const Simulation scene = simulation_of(folder, text.str());
  EXPECT_NEAR(scene.materials[0].reflectance[0][0], 0.15, 1e-12);
  EXPECT_NEAR(scene.materials[0].reflectance[1][1], 0.35, 1e-12);
  EXPECT_NEAR(scene.materials[0].transmittance[0], 0.25, 1e-12);
  EXPECT_NEAR(scene.materials[0].transmittance[1], 0.45, 1e-12);
}

TEST(Input, WhatIsImpossibleIsRefusedWhereItStands) {
  const auto expect = [](const Text& text, const std::string& part) {
    const TemporaryFolder folder;
    folder.write("short.csv", "nm,rho\n600,0.1\n700,0.2\n");
    BPMS_EXPECT_ERROR(simulation_of(folder, text.str()), ErrorKind::bad_input, part);
  };
  Text text;
  for (const char* zenith : {"90.0", "95", "-1.0"}) {
    text.sun = std::string("sun = { zenith_deg = ") + zenith + ", azimuth_deg = 0.0, irradiance = \"brf\" }";
    expect(text, "sun.zenith_deg");
  }
  text = {};
  text.leaf = "type = \"bilambertian\"\nreflectance = 0.7\ntransmittance = [[600, 0.2], [900, 0.4]]\n";
  expect(text, "band 2 (850 nm)");
  text.leaf = "type = \"bilambertian\"\nreflectance = -0.1\ntransmittance = 0.1\n";
  expect(text, "scene.toml:5:15");
  text.leaf = "type = \"lambertian\"\nreflectance = \"short.csv\"\n";
  expect(text, "does not hold band 2 (850 nm)");
  text.leaf = "type = \"lambertain\"\nreflectance = 0.1\n";
  expect(text, "lambertian");
  text.leaf = "type = \"lambertian\"\nreflectence = 0.1\n";
  expect(text, "reflectance");
  text = {};
  text.bands = "[bands]\nwavelengths_nm = [650, 2501]\n";
  expect(text, "2500");
  text.bands = "[bands]\nresponse = \"S2A.csv\"\n";
  expect(text, "not built yet");
  text = {};
  text.sampling = "samples = 64\ntarget_se = 0.1\n";
  expect(text, "one of target_se and samples");
  text.sampling = "target_se = \"-1%\"\n";
  expect(text, "above 0");
  text.sampling = "samples = 64\nmax_ordr = 3\n";
  expect(text, "max_order");
  text = {};
  text.sun = "sky = { type = \"isotropic\" }";
  expect(text, "radiance and irradiance");
}

}  // namespace
}  // namespace bpms::test
