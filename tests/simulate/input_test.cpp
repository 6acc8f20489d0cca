// What the reader of scene.toml refuses, and where it says so.
#include <gmock/gmock.h>

#include "tests/simulate/scene_text.h"

namespace bpms::test {
namespace {

const SceneText good{.domain = "size_m = [1, 1]",
                     .leaf = bilambertian("0.4", "0.3"),
                     .ground = "leaf",
                     .sun = sun_at(30, 0),
                     .sensor = views("[[0, 0]]"),
                     .wavelengths_nm = "[650, 850]",
                     .sampling = "samples = 64"};

TEST(Input, SpectraAreInterpolatedToTheBands) {
  const TemporaryFolder folder;
  folder.write("tau.csv", "nm,tau\n400,0.0\n900,0.5\n");
  SceneText text = good;
  text.leaf = bilambertian("[[600, 0.1], [700, 0.2], [900, 0.4]]", "\"tau.csv\"");
  const Simulation scene = simulation_of(folder, text);
  EXPECT_NEAR(scene.materials[0].reflectance[0][0], 0.15, 1e-12);
  EXPECT_NEAR(scene.materials[0].reflectance[1][1], 0.35, 1e-12);
  EXPECT_NEAR(scene.materials[0].transmittance[0], 0.25, 1e-12);
  EXPECT_NEAR(scene.materials[0].transmittance[1], 0.45, 1e-12);
}

TEST(Input, WhatIsImpossibleIsRefusedWhereItStands) {
  struct Case {
    std::string SceneText::*piece;
    std::string text;
    const char* message;
  };
  const Case cases[] = {
      {&SceneText::sun, sun_at(90, 0), "sun.zenith_deg"},
      {&SceneText::sun, sun_at(95, 0), "sun.zenith_deg"},
      {&SceneText::sun, sun_at(-1, 0), "sun.zenith_deg"},
      {&SceneText::leaf, bilambertian("0.7", "[[600, 0.2], [900, 0.4]]"), "band 2 (850 nm)"},
      {&SceneText::leaf, bilambertian("-0.1", "0.1"), "scene.toml:5:15"},
      {&SceneText::leaf, lambertian("\"french.csv\""), "french.csv:1"},
      {&SceneText::leaf, lambertian("\"short.csv\""), "does not hold band 2 (850 nm)"},
      {&SceneText::leaf, "type = \"lambertain\"\nreflectance = 0.1", "lambertian"},
      {&SceneText::leaf, "type = \"lambertian\"\nreflectence = 0.1", "reflectance"},
      {&SceneText::wavelengths_nm, "[650, 2501]", "2500"},
      {&SceneText::wavelengths_nm, "[650]\nresponse = \"S2A.csv\"", "expected one of wavelengths_nm"},
      {&SceneText::sampling, "samples = 64\ntarget_se = 0.1", "one of target_se and samples"},
      {&SceneText::sampling, "target_se = \"-1%\"", "above 0"},
      {&SceneText::sampling, "samples = 64\nmax_ordr = 3", "max_order"},
      {&SceneText::sky, "{ type = \"isotropic\" }", "radiance and irradiance"},
  };
  const TemporaryFolder folder;
  folder.write("french.csv", "400;0,05\n900;0,5\n");
  folder.write("short.csv", "nm,rho\n600,0.1\n700,0.2\n");
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    SceneText text = good;
    text.*c.piece = c.text;
    BPMS_EXPECT_ERROR(simulation_of(folder, text), ErrorKind::bad_input, c.message);
  }
}

}  // namespace
}  // namespace bpms::test
