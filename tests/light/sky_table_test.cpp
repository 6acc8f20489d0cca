#include "tests/light/light_text.h"

namespace bpms::test {
namespace {

// Radiance 1 + zenith/90 + azimuth/360 at 600 nm, in proportion to the wavelength.
std::string table(int zeniths = 4, int azimuths = 8) {
  std::string out = "zenith_deg,azimuth_deg,wavelength_nm,radiance\n";
  for (int z = 0; z < zeniths; ++z)
    for (int a = 0; a < azimuths; ++a)
      for (const int nm : {600, 800}) {
        const double zenith = 90.0 * z / (zeniths - 1), azimuth = 360.0 * a / azimuths;
        out +=
            fmt::format("{},{},{},{}\n", zenith, azimuth, nm, nm / 600.0 * (1 + zenith / 90 + azimuth / 360));
      }
  return out;
}

struct MapFile : ::testing::Test {
  TemporaryFolder folder;
  LightScene scene;
  MapFile() { scene.bands.wavelengths_nm = {600, 650}; }
  Light read(const std::string& csv, const std::string& more = "") {
    folder.write("sky.csv", csv);
    return scene.read("[sky]\ntype = \"map\"\nfile = \"sky.csv\"\n" + more, folder / "scene.toml");
  }
  std::vector<float> seen(const Light& light, double zenith_deg, double azimuth_deg) {
    std::vector<float> out(scene.bands.count());
    light.sky->map->radiance(sky_at(zenith_deg, azimuth_deg, scene.domain), out);
    return out;
  }
};

TEST_F(MapFile, IsReadAndInterpolated) {
  const Light light = read(table());
  const auto at = seen(light, 30, 90);
  EXPECT_NEAR(at[0], 1 + 1.0 / 3 + 0.25, 1e-5);
  EXPECT_NEAR(at[1], at[0] * 650 / 600, 1e-5);
  EXPECT_NEAR(light.diffuse_irradiance(2)[0], light.sky->map->irradiance()[0], 1e-9);
}

TEST_F(MapFile, BandsLieBetweenItsWavelengths) {
  const Light light =
      read("zenith_deg,azimuth_deg,wavelength_nm,radiance\n0,0,600,1\n90,0,600,1\n0,0,700,3\n90,0,700,3\n");
  EXPECT_NEAR(seen(light, 50, 10)[0], 1, 1e-6);
  EXPECT_NEAR(seen(light, 50, 10)[1], 2, 1e-6);
}

TEST_F(MapFile, AzimuthsAreTheScenes) {
  for (const bool north : {true, false}) {
    scene.domain.azimuth_north_clockwise = north;
    const Light light = read(table());
    for (const double azimuth_deg : {0.0, 90.0, 225.0})
      EXPECT_NEAR(seen(light, 60, azimuth_deg)[0], 1 + 2.0 / 3 + azimuth_deg / 360, 1e-5) << north;
  }
}

TEST_F(MapFile, OneZenithValueAndNoWavelengthWillDo) {
  const Light light = read("zenith_deg,azimuth_deg,radiance\n0,0,4\n90,0,1\n90,90,2\n90,180,1\n90,270,2\n");
  EXPECT_NEAR(seen(light, 0, 0)[1], 4, 1e-6);
  EXPECT_NEAR(seen(light, 0.001, 200)[1], 4, 1e-3);
  EXPECT_NEAR(seen(light, 90, 45)[0], 1.5, 1e-5);
}

TEST_F(MapFile, IsScaled) {
  EXPECT_NEAR(seen(read(table(), "scale = 3"), 60, 0)[0], 5, 1e-5);
  for (const double e : read(table(), "irradiance = \"brf\"").diffuse_irradiance(2)) EXPECT_NEAR(e, pi, 1e-6);
  const std::vector<double> e = read(table(), "irradiance = [[600, 100], [650, 300]]").diffuse_irradiance(2);
  EXPECT_NEAR(e[0], 100, 1e-5);
  EXPECT_NEAR(e[1], 300, 1e-5);
}

TEST_F(MapFile, RefusesWhatIsNoMap) {
  struct Case {
    std::string csv, more;
    const char* message;
  };
  const std::string head = "zenith_deg,azimuth_deg,radiance\n";
  const Case cases[] = {
      {"zenith,azimuth_deg,radiance\n0,0,1\n", "", "zenith_deg"},
      {head, "", "no rows"},
      {head + "0,0,1\n80,0,1\n", "", "zenith_deg has 2 values and 80 among them: expected 0, 90"},
      {head + "0,0,1\n90,0,1\n90,100,1\n", "", "azimuth_deg has 2 values and 100 among them"},
      {head + "0,0,1\n90,0,1\n0,180,1\n0,360,1\n", "", "azimuth_deg has 3 values"},
      {head + "0,0,1\n45,0,1\n90,0,1\n90,180,1\n", "",
       "no radiance at zenith_deg 45, azimuth_deg 180: expected"},
      {head + "0,0,1\n90,0,1\n90,0,2\n", "", "sky.csv:4:6: a second value"},
      {head + "0,0,-1\n90,0,1\n", "", "sky.csv:2:5: radiance -1"},
      {head + "0,0,1\n90,0,x\n", "", "sky.csv:3:6"},
      {head + "0,0,0\n90,0,0\n", "irradiance = 100", "the sky is black in band 1 (600 nm)"},
      {head + "0,0,1\n90,0,1\n", "scale = 2\nirradiance = 3", "says it already"},
      {head + "0,0,1\n90,0,1\n", "scale = 0", "scale"},
      {"zenith_deg,azimuth_deg,wavelength_nm,radiance\n0,0,0.6,1\n90,0,0.6,1\n", "",
       "look like micrometres (um)"},
      {"zenith_deg,azimuth_deg,wavelength_nm,radiance\n0,0,620,1\n90,0,620,1\n", "",
       "does not hold band 1 (600 nm)"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.csv + c.more);
    BPMS_EXPECT_ERROR(read(c.csv, c.more), ErrorKind::bad_input, c.message);
  }
  scene.domain.azimuth_north_clockwise = false;
  BPMS_EXPECT_ERROR(read(table(4, 9)), ErrorKind::bad_input, "a multiple of 4");
}

}  // namespace
}  // namespace bpms::test
