// Tables of measured or modelled reflectance.
#include "simulate/materials/rpv.h"
#include "tests/materials/lobe_checks.h"

namespace bpms::test {
namespace {

const std::string header = "theta_i_deg,theta_r_deg,delta_phi_deg,wavelength_nm,brf\n";
const std::string soil = "type = \"tabulated\"\nfile = \"soil.csv\"\n";

ReflectionAngles at_angles(double light_deg, double view_deg, double azimuth_deg) {
  return reflection_angles(direction(view_deg, 0).cast<double>(),
                           direction(light_deg, azimuth_deg).cast<double>());
}

double published(double light_deg, double view_deg, double azimuth_deg, double nm) {
  const RpvParameters p{nm == 600 ? 0.1 : 0.25, nm == 600 ? 0.7 : 0.9, -0.15, 0.3};
  return rpv_brf(p, at_angles(light_deg, view_deg, azimuth_deg));
}

// RPV in two wavelengths every 15 and 30 degrees.
std::string rpv_as_table() {
  std::string out = header;
  for (const int nm : {600, 800})
    for (int i = 0; i <= 75; i += 15)
      for (int r = 0; r <= 75; r += 15)
        for (int a = 0; a <= 180; a += 30)
          out += fmt::format("{},{},{},{},{:.9g}\n", i, r, a, nm, published(i, r, a, nm));
  return out;
}

TEST(Tabulated, GivesTheTableAndIsLinearInBetween) {
  const TemporaryFolder folder;
  folder.write("soil.csv", rpv_as_table());
  const Material material = material_of(folder, soil, {600, 700, 800});
  ASSERT_EQ(material.lobes.size(), 1u);
  const SurfaceLobe& lobe = material.lobes[0];
  EXPECT_FALSE(lobe.lobe->separable());
  EXPECT_TRUE(lobe.lobe->reciprocal());
  EXPECT_TRUE(material.opaque);
  const auto value = [&](double i, double r, double a, std::size_t band) {
    return pi * values_of(lobe, direction(r, 0), direction(i, a), 3)[band];
  };
  EXPECT_NEAR(value(30, 60, 120, 0), published(30, 60, 120, 600), 2e-6);
  EXPECT_NEAR(value(45, 15, 30, 2), published(45, 15, 30, 800), 2e-6);
  EXPECT_NEAR(value(30, 60, 120, 1), (published(30, 60, 120, 600) + published(30, 60, 120, 800)) / 2, 2e-6);
  EXPECT_NEAR(value(35, 60, 120, 0), (2 * published(30, 60, 120, 600) + published(45, 60, 120, 600)) / 3,
              2e-6);
  EXPECT_NEAR(value(30, 50, 120, 0), (2 * published(30, 45, 120, 600) + published(30, 60, 120, 600)) / 3,
              2e-6);
  EXPECT_NEAR(value(30, 60, -110, 0), (published(30, 60, 90, 600) + 2 * published(30, 60, 120, 600)) / 3,
              2e-6);
  EXPECT_NEAR(value(85, 60, 120, 0), published(75, 60, 120, 600), 2e-6);  // kept beyond the last
  ASSERT_EQ(material.notes.size(), 2u);
  EXPECT_THAT(material.notes[0], ::testing::HasSubstr("theta_i_deg ends at 75"));
  check_lobe("table", lobe, 3, {.largest_weight = 3});
}

TEST(Tabulated, WithoutWavelengthsIsSeparable) {
  const TemporaryFolder folder;
  folder.write("soil.csv",
               "theta_i_deg,theta_r_deg,delta_phi_deg,brf\n0,0,0,0.1\n0,90,0,0.2\n90,0,0,0.2\n90,90,0,0.4\n");
  const Material material = material_of(folder, soil + "face = \"front\"", {600, 700});
  EXPECT_TRUE(material.lobes[0].lobe->separable());
  EXPECT_EQ(material.lobes[0].on_face, (std::array<bool, 2>{true, false}));
  EXPECT_TRUE(material.notes.empty());
  EXPECT_NEAR(pi * values_of(material.lobes[0], direction(45, 0), direction(45, 77), 2)[1], 0.225, 1e-6);
  check_lobe("table of zeniths", material.lobes[0], 2, {.largest_weight = 3});
}

TEST(Tabulated, SaysWhatIsNotReciprocal) {
  const TemporaryFolder folder;
  folder.write("soil.csv",
               "theta_i_deg,theta_r_deg,delta_phi_deg,brf\n0,0,0,0.1\n0,90,0,0.3\n90,0,0,0.1\n90,90,0,0.4\n");
  const Material material = material_of(folder, soil);
  ASSERT_EQ(material.notes.size(), 1u);
  EXPECT_THAT(material.notes[0], ::testing::HasSubstr("changes it by up to 100.0 %"));
  check_lobe("one-way table", material.lobes[0], 1, {.largest_weight = 3, .reciprocal = false});
}

TEST(Tabulated, WithMistakesGetsOneLine) {
  struct Case {
    std::string text;
    const char* message;
  };
  const Case cases[] = {
      {header, "soil.csv: no rows"},
      {"theta_i_deg,theta_r_deg,brf\n0,0,0.1\n", "delta_phi_deg"},
      {header + "0,0,0,650,0.1\n0,30,0,650,0.1\n30,0,0,650,0.1\n",
       "3 rows: expected 2 light zeniths x 2 view"},
      {header + "0,0,0,650,0.1\n0,0,0,650,0.1\n", "2 rows"},
      {header + "0,0,0,650,0.1\n0,10,0,650,0.1\n0,0,0,700,0.1\n0,0,0,700,0.1\n",
       "soil.csv:5:11: a second row"},
      {header + "0,0,0,650,-0.1\n", "soil.csv:2:11: brf is -0.1"},
      {header + "0,95,0,650,0.1\n", "soil.csv:2:3: theta_r_deg is 95"},
      {header + "0,0,0,650,nan\n", "soil.csv:2:11"},
      {header + "0,0,0,650,0.1\n0,0,90,650,0.1\n", "delta_phi_deg from 0 to 90: expected 0 to 180"},
      {header + "0,0,0,700,0.1\n0,0,0,800,0.1\n", "700 to 800 nm, which do not hold band 1 (650 nm)"},
      {header + "0,0,0,0.6,0.1\n0,0,0,0.8,0.1\n", "look like micrometres: expected nm"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    const TemporaryFolder folder;
    folder.write("soil.csv", c.text);
    BPMS_EXPECT_ERROR(material_of(folder, soil), ErrorKind::bad_input, c.message);
  }
  BPMS_EXPECT_ERROR(material_of(soil), ErrorKind::missing_resource, "soil.csv");
}

}  // namespace
}  // namespace bpms::test
