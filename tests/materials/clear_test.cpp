// Mirrors and clear sheets, and the energy of what is made of them.
#include "tests/materials/materials_of.h"

namespace bpms::test {
namespace {

TEST(Transparent, LetsLightThroughStraight) {
  const Material clear = material_of("type = \"transparent\"");
  ASSERT_EQ(clear.lobes.size(), 1u);
  EXPECT_FALSE(clear.opaque);
  const Lobe& lobe = *clear.lobes[0].lobe;
  EXPECT_TRUE(lobe.is_delta() && lobe.is_straight());
  EXPECT_EQ(clear.lobes[0].spectrum, std::vector<double>{1});
  const Eigen::Vector3f view = direction(40, 130);
  Eigen::Vector3f light;
  ASSERT_TRUE(lobe.sample(view, 0.3f, 0.7f, light));
  EXPECT_EQ(light, -view);
  EXPECT_EQ(material_of("type = \"transparent\"\ntransmittance = 0.3").lobes[0].spectrum[0], 0.3);
}

TEST(Srm, HasLambertsPartsAMirrorAndStraightTransmittance) {
  const Material material = material_of(
      "type = \"srm\"\nreflectance = 0.2\ntransmittance = [[600, 0.1], [700, 0.2]]\n"
      "specular_reflectance = 0.3\nspecular_transmittance = 0.25",
      {600, 700});
  EXPECT_EQ(material.reflectance[0], (std::vector<double>{0.2, 0.2}));
  EXPECT_EQ(material.reflectance[1], material.reflectance[0]);
  EXPECT_EQ(material.transmittance, (std::vector<double>{0.1, 0.2}));
  ASSERT_EQ(material.lobes.size(), 2u);
  EXPECT_EQ(material.lobes[0].spectrum[0], 0.3);
  EXPECT_EQ(material.lobes[1].spectrum[0], 0.25);
  EXPECT_TRUE(material.lobes[0].lobe->is_delta() && !material.lobes[0].lobe->is_straight());
  EXPECT_TRUE(material.lobes[1].lobe->is_straight());
  EXPECT_FALSE(material.opaque);
  const Eigen::Vector3f view = direction(40, 130);
  Eigen::Vector3f light;
  ASSERT_TRUE(material.lobes[0].lobe->sample(view, 0.3f, 0.7f, light));
  EXPECT_LT((light - direction(40, 310)).norm(), 1e-6f);
}

TEST(Srm, IsOpaqueWithoutTransmittance) {
  EXPECT_TRUE(material_of("type = \"srm\"\nspecular_reflectance = 1.0").opaque);
  EXPECT_TRUE(material_of("type = \"srm\"\nreflectance = 1.0").is_diffuse());
}

TEST(Srm, GivesOutNoMoreThanItReceives) {
  BPMS_EXPECT_ERROR(
      material_of("type = \"srm\"\nreflectance = 0.4\nspecular_transmittance = [[600, 0.6], [700, 0.7]]",
                  {600, 700}),
      ErrorKind::bad_input, "= 1.1 in band 2 (700 nm): expected a sum of at most 1");
}

TEST(Spectra, WithMistakesGetOneLine) {
  struct Case {
    const char* body;
    const char* message;
  };
  const Case cases[] = {
      {"type = \"srm\"\nreflectance = nan", "scene.toml:3:"},
      {"type = \"srm\"\nreflectance = -0.1", "expected a value from 0 to 1"},
      {"type = \"srm\"\nspecular_reflectance = [[400, 0.1], [500, 0.2]]", "does not hold band 1 (650 nm)"},
      {"type = \"transparent\"\ntransmittance = 1.5", "expected a value from 0 to 1"},
      {"type = \"transparent\"\ntransmitance = 0.5", "transmittance"},
      {"type = \"mirror\"", "srm"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.body);
    BPMS_EXPECT_ERROR(material_of(c.body), ErrorKind::bad_input, c.message);
  }
}

TEST(Spectra, InFilesWithMistakesGetOneLine) {
  struct Case {
    const char* file;
    const char* message;
  };
  const Case cases[] = {
      {"nm,rho\n400,0.1\n900,nan\n", "s.csv:3:5: expected a wavelength in nm and a value"},
      {"nm,rho\n400,-0.1\n900,-0.1\n", "reflectance in band 1 (650 nm) is -0.1"},
      {"nm,rho\n900,0.1\n400,0.1\n", "s.csv:3:"},
      {"nm,rho\n700,0.1\n900,0.1\n", "does not hold band 1 (650 nm)"},
      {"nm,rho\n", "s.csv"},
      {"nm,rho\n400\n", "s.csv:2:"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.file);
    const TemporaryFolder folder;
    folder.write("s.csv", c.file);
    BPMS_EXPECT_ERROR(material_of(folder, "type = \"srm\"\nreflectance = \"s.csv\""), ErrorKind::bad_input,
                      c.message);
  }
}

}  // namespace
}  // namespace bpms::test
