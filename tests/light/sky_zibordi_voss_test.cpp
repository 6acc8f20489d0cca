// The model as a scene states it.
#include "simulate/light/zibordi_voss.h"
#include "tests/light/light_text.h"

namespace bpms::test {
namespace {

namespace zv = zibordi_voss;

const std::string sun = "sun = { zenith_deg = 40, azimuth_deg = 130, irradiance = \"zibordi_voss\" }\n";
std::string sky(const std::string& more = "") {
  return "[sky]\ntype = \"zibordi_voss\"\nextraterrestrial = 1800\nozone_absorption = 0.02\n"
         "water_absorption = 0.1\ngas_absorption = 0.001\nsurface_albedo = 0.2\n" +
         more;
}

LightScene three_bands() {
  LightScene out;
  out.bands.wavelengths_nm = {450, 650, 850};
  return out;
}

zv::Depths default_depths(double nm, const zv::Atmosphere& atmosphere = {}) {
  return zv::depths(atmosphere, nm, 0.02, 0.1, 0.001);
}

// The map holds the model at its points; its irradiance is the model's, by a finer quadrature of the model.
TEST(SkyZibordiVoss, MapIsTheModel) {
  LightScene scene = three_bands();
  const Light light = scene.read(sun + sky());
  ASSERT_TRUE(light.sky && light.sky->map);
  EXPECT_TRUE(scene.notes.empty());
  for (std::size_t band = 0; band < 3; ++band) {
    const zv::ClearSky model({}, default_depths(scene.bands.wavelengths_nm[band]), radians(40), 0.2);
    const Eigen::Vector3d to_sun = light.suns[0].direction;
    const auto radiance = [&](const Eigen::Vector3d& to) {
      return 1800 * model.radiance(to.z(), to.dot(to_sun));
    };
    std::vector<float> out(3);
    for (const double zenith_deg : {0.0, 30.0, 40.0, 77.0})
      for (const double azimuth_deg : {0.0, 120.0, 129.0, 300.0}) {
        light.sky->map->radiance(sky_at(zenith_deg, azimuth_deg), out);
        const double expected = radiance(sky_at(zenith_deg, azimuth_deg).cast<double>());
        EXPECT_NEAR(out[band], expected, 1e-5 * expected);  // 32-bit angles
      }
    double flux = 0;
    constexpr int rows = 900, columns = 720;
    for (int i = 0; i < rows; ++i)
      for (int k = 0; k < columns; ++k) {
        const double zenith = pi / 2 * (i + 0.5) / rows, azimuth = 2 * pi * (k + 0.5) / columns;
        flux += radiance(direction_from_angles(zenith, azimuth, {})) * std::cos(zenith) * std::sin(zenith) *
                (pi / 2 / rows) * (2 * pi / columns);
      }
    EXPECT_NEAR(light.diffuse_irradiance(3)[band], flux, 1e-3 * flux);
  }
}

TEST(SkyZibordiVoss, SunTakesItsIrradianceFromIt) {
  LightScene scene = three_bands();
  const Light light = scene.read(sun + sky("day_of_year = 3"));
  for (std::size_t band = 0; band < 3; ++band) {
    const double total = default_depths(scene.bands.wavelengths_nm[band]).total();
    const double expected = 1800 * 1.01672 * 1.01672 * std::exp(-total * zv::air_mass(40));
    EXPECT_NEAR(light.suns[0].irradiance[band], expected, 1e-9 * expected);
  }
  // Or keeps its own.
  const Light own = scene.read("sun = { zenith_deg = 40, azimuth_deg = 130, irradiance = 900 }\n" + sky());
  EXPECT_EQ(own.suns[0].irradiance[1], 900);
}

TEST(SkyZibordiVoss, BelongsToTheSunItNames) {
  LightScene scene = three_bands();
  const std::string two =
      "[[sun]]\nname = \"lamp\"\nzenith_deg = 0\nazimuth_deg = 0\nirradiance = 5\n"
      "[[sun]]\nname = \"sun\"\nzenith_deg = 60\nazimuth_deg = 90\nirradiance = \"zibordi_voss\"\n";
  const Light light = scene.read(two + sky("sun = \"sun\""));
  EXPECT_EQ(light.suns[0].irradiance[0], 5);
  EXPECT_GT(light.suns[1].irradiance[0], 500);
  // Brightest about that sun, in the east at 60 degrees.
  std::vector<float> near(3), far(3);
  light.sky->map->radiance(sky_at(60, 90), near);
  light.sky->map->radiance(sky_at(60, 270), far);
  EXPECT_GT(near[2], 3 * far[2]);
}

// A profile of density exp(-h/5) leaves exp(-1/5) above 1 km: by trapezoids of 0.1 km, within 1e-4; the top
// at 100 km leaves out e^-20.
TEST(SkyZibordiVoss, ProfilesSayWhatIsLeftAboveAnAltitude) {
  const TemporaryFolder folder;
  std::string profile = "# km density\n";
  for (int i = 0; i <= 1000; ++i) profile += fmt::format("{} {:.12g}\n", 0.1 * i, std::exp(-0.02 * i));
  folder.write("aerosol.txt", profile);
  LightScene scene = three_bands();
  const Light light = scene.read(sun + sky("altitude_km = 1\nprofiles = { aerosol = \"aerosol.txt\" }"),
                                 folder / "scene.toml");
  zv::Atmosphere atmosphere;
  atmosphere.rayleigh_above = zv::rayleigh_above(1);
  atmosphere.ozone_above = zv::ozone_above(1, 20, 5);
  atmosphere.water_above = zv::water_above(1, 1.4, 10.02);
  atmosphere.aerosol_above = std::exp(-0.2);
  const double expected = 1800 * std::exp(-default_depths(650, atmosphere).total() * zv::air_mass(40));
  EXPECT_NEAR(light.suns[0].irradiance[1], expected, 1e-4 * expected);
}

TEST(SkyZibordiVoss, ReadsTheTablesOfItsAuthors) {
  BPMS_NEED_DATA("sky/KO3");
  LightScene scene;
  scene.bands.wavelengths_nm = {450, 550, 760, 850, 940};
  const Light light = scene.read(sun + "[sky]\ntype = \"zibordi_voss\"\ntables = \"" + data_folder() +
                                 "/sky\"\nsurface_albedo = \"" + data_folder() + "/sky/veg.albedo\"\n");
  EXPECT_EQ(scene.inputs.size(), 5u);
  const std::vector<double> direct = light.direct_irradiance(5), diffuse = light.diffuse_irradiance(5);
  const std::vector<double>& beam = light.suns[0].irradiance;
  // The sky is blue; oxygen at 760 nm and water at 940 nm take from the sun.
  EXPECT_GT(diffuse[0] / direct[0], 1.2 * diffuse[1] / direct[1]);
  EXPECT_GT(diffuse[0] / direct[0], 2 * diffuse[3] / direct[3]);
  EXPECT_LT(beam[2], beam[3]);
  EXPECT_LT(beam[4], beam[3]);
}

TEST(SkyZibordiVoss, RefusesWhatItCannotUse) {
  struct Case {
    std::string text;
    const char* message;
  };
  const TemporaryFolder folder;
  folder.write("E0D", "600 1500\n900 1000\n");
  folder.write("low.txt", "5 1\n9 0\n");
  const std::string none = "[sky]\ntype = \"zibordi_voss\"\nsurface_albedo = 0.2\n";
  const Case cases[] = {
      {sky(), "needs a sun"},
      {sun + none, "missing key 'extraterrestrial', or tables = \"FOLDER\" that holds a file E0D"},
      {sun + none + "tables = \".\"", "runs from 600 to 900 nm, which does not hold band 1 (450 nm)"},
      {sun + sky("sun = \"moon\""), "no sun named 'moon'"},
      {sun + sky("aerosol = { beta = -1 }"), "sky.aerosol.beta"},
      {sun + sky("aerosol = { single_scattering_albedo = 1.1 }"), "single_scattering_albedo"},
      {sun + sky("aerosol = { henyey_greenstein = [0.9, 1, 0] }"), "between -1 and 1"},
      {sun + sky("aerosol = { gamma = 1 }"), "gamma"},
      {sun + sky("profiles = { ozone = \"low.txt\" }"), "act with altitude_km only"},
      {sun + sky("altitude_km = 1\nprofiles = { ozone = \"low.txt\" }"), "runs from 5 to 9 km"},
      {sun + sky("zeniths = 1"), "sky.zeniths"},
      {sun, "no sky of type \"zibordi_voss\" belongs to sun \"sun\""},
      {sun + "[sky]\ntype = \"isotropic\"\nradiance = 1", "no sky of type \"zibordi_voss\" belongs"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    LightScene scene = three_bands();
    BPMS_EXPECT_ERROR(scene.read(c.text, folder / "scene.toml"), ErrorKind::bad_input, c.message);
  }
  LightScene colourless;
  BPMS_EXPECT_ERROR(colourless.read(sun + sky()), ErrorKind::bad_input, "needs [bands]");
}

}  // namespace
}  // namespace bpms::test
