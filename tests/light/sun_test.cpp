// Suns, and spectra of sources from files.
#include "tests/light/light_text.h"

namespace bpms::test {
namespace {

std::string sun(const std::string& irradiance, const std::string& more = "") {
  return "[sun]\nzenith_deg = 60\nazimuth_deg = 90\nirradiance = " + irradiance + "\n" + more;
}

TEST(Sun, OfAFiniteDiscHasARadius) {
  LightScene scene;
  const Light light = scene.read(sun("100", "radius_deg = 0.2666"));
  EXPECT_NEAR(light.suns[0].radius, radians(0.2666), 1e-15);
  EXPECT_NEAR(light.direct_irradiance(1)[0], 50, 1e-12);
  EXPECT_EQ(scene.read(sun("100")).suns[0].radius, 0);
}

TEST(Sun, SeveralGiveEachItsOwnReflectanceFactor) {
  LightScene scene;
  const Light light = scene.read(
      "[[sun]]\nzenith_deg = 0\nazimuth_deg = 0\nirradiance = \"brf\"\n"
      "[[sun]]\nzenith_deg = 60\nazimuth_deg = 0\nirradiance = \"brf\"\n");
  ASSERT_EQ(light.suns.size(), 2u);
  EXPECT_NEAR(light.suns[0].irradiance[0], pi, 1e-12);
  EXPECT_NEAR(light.suns[1].irradiance[0], 2 * pi, 1e-12);
  EXPECT_NEAR(light.direct_irradiance(1, 1)[0], pi, 1e-12);
}

TEST(Sun, ColumnOfAFilePerNanometre) {
  const TemporaryFolder folder;
  folder.write("g173.csv",
               "A title,,,\nwavelength,extraterrestrial,global,direct\n500,2,1.5,1.25\n510,2,1.5,1.75\n");
  LightScene scene;
  scene.bands.wavelengths_nm = {500, 504};
  const auto irradiance = [&](const std::string& table) {
    return scene.read(sun(table), folder / "scene.toml").suns[0].irradiance;
  };
  EXPECT_THAT(irradiance("{ file = \"g173.csv\", column = \"direct\", unit_per = \"nm\" }"),
              ::testing::ElementsAre(::testing::DoubleNear(1250, 1e-9), ::testing::DoubleNear(1450, 1e-9)));
  EXPECT_NEAR(irradiance("{ file = \"g173.csv\", column = 3 }")[0], 1.5, 1e-12);
  EXPECT_NEAR(irradiance("{ file = \"g173.csv\" }")[0], 2, 1e-12);
  folder.write("again.txt", "500 2\n500 2\n510 4\n");
  EXPECT_NEAR(irradiance("{ file = \"again.txt\" }")[1], 2.8, 1e-12);
}

// Its direct normal irradiance is 900.1 W m-2 as the standard states, 892.3 of it up to 2500 nm.
TEST(Sun, ReadsTheStandardSpectrum) {
  BPMS_NEED_DATA("optics/astm/ASTMG173.csv");
  LightScene scene;
  for (double nm = 280.5; nm < 2500; nm += 1) scene.bands.wavelengths_nm.push_back(nm);
  const std::string file = data_folder() + "/optics/astm/ASTMG173.csv";
  const Light light = scene.read(sun("{ file = \"" + file + "\", column = \"direct\", unit_per = \"nm\" }"));
  double total = 0;
  for (const double e : light.suns[0].irradiance) total += e / 1000;  // steps of 1 nm
  EXPECT_NEAR(total, 892.3, 0.5);                                     // by steps of 1 nm, from 280 nm
}

TEST(Sun, RefusesWhatIsNoSun) {
  struct Case {
    std::string text;
    const char* message;
  };
  const TemporaryFolder folder;
  folder.write("um.csv", "um,e\n0.4,1\n0.9,1\n");
  folder.write("two.csv", "nm,direct,global\n400,1,2\n900,1,2\n");
  folder.write("short.csv", "nm,direct,global\n400,1,2\n900,1\n");
  folder.write("back.csv", "nm,direct\n900,1\n400,2\n");
  folder.write("twice.csv", "400,1\n400,2\n");
  folder.write("text.csv", "nm,direct\n400,1\n500,x\n");
  folder.write("negative.csv", "400,-1\n900,-1\n");
  folder.write("one.csv", "400\n900\n");
  const Case cases[] = {
      {sun("1", "radius_deg = 11"), "sun.radius_deg"},
      {sun("1", "radius_deg = -1"), "sun.radius_deg"},
      {"[sun]\nzenith_deg = 85\nazimuth_deg = 0\nirradiance = 1\nradius_deg = 5", "below the horizon"},
      {sun("1", "radus_deg = 1"), "radius_deg"},
      {sun("{ file = \"um.csv\" }"),
       "um.csv: wavelengths from 0.4 to 0.9 look like micrometres (um): expected nm"},
      {sun("{ file = \"two.csv\", column = \"diffuse\" }"),
       "no column 'diffuse': expected one of 'direct', 'global'"},
      {sun("{ file = \"two.csv\", column = 4 }"), "no column 4 of values"},
      {sun("{ file = \"two.csv\", column = 1 }"), "column"},
      {sun("{ file = \"short.csv\", column = \"global\" }"), "short.csv:3: 2 columns: expected 3"},
      {sun("{ file = \"back.csv\" }"), "back.csv:3:1: 400 does not come after 900"},
      {sun("{ file = \"twice.csv\" }"), "twice.csv:2:1: 400 does not come after 400"},
      {sun("{ file = \"text.csv\" }"), "text.csv:3:5: expected a number, found 'x'"},
      {sun("{ file = \"negative.csv\" }"), "expected a value from 0"},
      {sun("{ file = \"negative.csv\", column = \"direct\" }"), "no header names the columns"},
      {sun("{ file = \"one.csv\" }"), "one column"},
      {sun("{ file = \"two.csv\", unit_per = \"m\" }"), "unit_per"},
      {sun("{ column = 2 }"), "file"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    LightScene scene;
    scene.bands.wavelengths_nm = {500};
    BPMS_EXPECT_ERROR(scene.read(c.text, folder / "scene.toml"), ErrorKind::bad_input, c.message);
  }
  LightScene beyond;
  beyond.bands.wavelengths_nm = {950};
  BPMS_EXPECT_ERROR(beyond.read(sun("{ file = \"two.csv\" }"), folder / "scene.toml"), ErrorKind::bad_input,
                    "which does not hold band 1 (950 nm)");
}

}  // namespace
}  // namespace bpms::test
