// Materials of materials.
#include "tests/materials/lobe_checks.h"

namespace bpms::test {
namespace {

const std::string parts = R"(
[materials.leaf]
type = "bilambertian"
reflectance = 0.4
reflectance_back = 0.5
transmittance = [[600, 0.1], [700, 0.3]]
[materials.bark]
type = "lambertian"
reflectance = 0.2
[materials.soil]
type = "rpv"
rho0 = 0.1
k = [[600, 0.6], [700, 0.8]]
theta = -0.1
[materials.mirror]
type = "srm"
specular_reflectance = 0.5
)";

TEST(Mixture, AddsUpFractions) {
  const TemporaryFolder folder;
  const Materials all =
      materials_of(folder,
                   "[materials.mix]\ntype = \"mixture\"\n"
                   "of = { leaf = [[600, 0.7], [700, 0.5]], bark = [[600, 0.3], [700, 0.5]] }" +
                       parts,
                   {600, 700});
  const Material& mix = all["mix"];
  EXPECT_NEAR(mix.reflectance[0][0], 0.7 * 0.4 + 0.3 * 0.2, 1e-12);
  EXPECT_NEAR(mix.reflectance[0][1], 0.5 * 0.4 + 0.5 * 0.2, 1e-12);
  EXPECT_NEAR(mix.reflectance[1][1], 0.5 * 0.5 + 0.5 * 0.2, 1e-12);
  EXPECT_NEAR(mix.transmittance[1], 0.5 * 0.3, 1e-12);
  EXPECT_FALSE(mix.opaque);
}

TEST(Mixture, AddsUpLobes) {
  const TemporaryFolder folder;
  const Materials all =
      materials_of(folder,
                   "[materials.mix]\ntype = \"mixture\"\n"
                   "of = { soil = [[600, 0.6], [700, 0.4]], mirror = [[600, 0.4], [700, 0.6]] }" +
                       parts,
                   {600, 700});
  const Material& mix = all["mix"];
  EXPECT_TRUE(mix.opaque);
  ASSERT_EQ(mix.lobes.size(), 2u);
  const bool soil_first = !mix.lobes[0].lobe->is_delta();
  const SurfaceLobe& soil = mix.lobes[soil_first ? 0 : 1];
  EXPECT_NEAR(mix.lobes[soil_first ? 1 : 0].spectrum[1], 0.3, 1e-12);
  const Eigen::Vector3f view = direction(30, 0), light = direction(50, 60);
  const std::vector<double> mixed = values_of(soil, view, light, 2),
                            pure = values_of(all["soil"].lobes[0], view, light, 2);
  EXPECT_NEAR(mixed[0], 0.6 * pure[0], 1e-7);
  EXPECT_NEAR(mixed[1], 0.4 * pure[1], 1e-7);
  check_lobe("mixture", soil, 2, {.largest_weight = 4});
}

TEST(Mixture, OfWhatIsNotThereOrOfItselfIsRefused) {
  struct Case {
    const char* of;
    const char* message;
  };
  const Case cases[] = {
      {"{ leaf = 0.5, brak = 0.5 }", "no [materials.brak]"},
      {"{ leaf = 0.5, bark = 0.4 }", "add up to 0.9 in band 1 (600 nm)"},
      {"{ leaf = 0.5, mix = 0.5 }", "which is made of itself"},
      {"{ leaf = 0.5, other = 0.5 }", "which is made of itself"},
      {"{ leaf = -0.5, bark = 1.5 }", "expected a value from 0 to 1"},
      {"[\"leaf\"]", "expected a table of fractions"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.of);
    const TemporaryFolder folder;
    BPMS_EXPECT_ERROR(materials_of(folder,
                                   std::string("[materials.mix]\ntype = \"mixture\"\nof = ") + c.of + parts +
                                       "[materials.other]\ntype = \"mixture\"\nof = { mix = 1 }\n",
                                   {600, 700}),
                      ErrorKind::bad_input, c.message);
  }
}

}  // namespace
}  // namespace bpms::test
