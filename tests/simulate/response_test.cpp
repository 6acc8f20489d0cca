// Bands with response functions: exact weighting of all wavelengths and Monte Carlo sampling of one a path
// agree.
#include <gmock/gmock.h>

#include <cmath>

#include "core/units.h"
#include "simulate/output/quantity.h"
#include "tests/simulate/scene_text.h"

namespace bpms::test {
namespace {

const char* const two_bands =
    "Wavelength\tred\tnir\n600\t0\t0\n620\t0.5\t0\n640\t1\t0\n660\t1\t0.1\n680\t0.2\t0\n"
    "700\t0\t0.3\n720\t0\t1\n740\t0\t1\n760\t0\t0.8\n780\t0\t0\n";

// BRF of a band: sum(w E rho) / sum(w E), the trapezoidal rule over the response's wavelengths.
TEST(Response, WeighsReflectanceByResponseAndIrradiance) {
  const TemporaryFolder folder;
  folder.write("s.tsv", two_bands);
  SceneText scene{.soil = lambertian("[[500, 0.1], [900, 0.5]]"), .sampling = "samples = 64"};
  scene.sun = sun_at(0, 0, "[[500, 500], [900, 1300]]");
  scene.sensor = views("[[0, 0]]");
  scene.bands = "response = \"s.tsv\"";
  const Simulation simulation = simulation_of(folder, scene);
  const SensorResult result = simulate(simulation, 1).sensors[0];
  const std::vector<double> scale = reflectance_scale(simulation, Origin::total);
  const double red_weight[] = {0.5, 1, 1, 0.2}, nir_weight[] = {0.1, 0.3, 1, 1, 0.8};
  const double red_nm[] = {620, 640, 660, 680}, nir_nm[] = {660, 700, 720, 740, 760};
  const auto expected = [](const double* weight, const double* nm, int count) {
    double above = 0, below = 0;
    for (int i = 0; i < count; ++i) {
      const double light = weight[i] * (500 + 2 * (nm[i] - 500));
      above += light * (0.1 + 0.001 * (nm[i] - 500));
      below += light;
    }
    return above / below;
  };
  EXPECT_NEAR(result.radiance[0].value[0] * scale[0], expected(red_weight, red_nm, 4), 1e-6);
  EXPECT_NEAR(result.radiance[0].value[1] * scale[1], expected(nir_weight, nir_nm, 5), 1e-6);
  EXPECT_EQ(simulation.bands.written_name(1), "nir");
}

// More than eight wavelengths are counted as interactions, few carried, one a band sampled: the same bands.
TEST(Response, SampledWavelengthsAgreeWithExactOnes) {
  const TemporaryFolder folder;
  folder.write("s.tsv", two_bands);
  SceneText scene = canopy_text(folder, {.lai = 2, .radius_m = 0.05, .size_m = {2, 2}, .top_m = 1});
  scene.leaf =
      bilambertian("[[500, 0.05], [690, 0.08], [900, 0.5]]", "[[500, 0.02], [690, 0.05], [900, 0.45]]");
  scene.soil = lambertian("[[500, 0.1], [900, 0.3]]");
  scene.sun = sun_at(30, 0, "[[500, 500], [900, 1300]]");
  scene.sky = "{ type = \"isotropic\", irradiance = [[500, 300], [900, 100]] }";
  scene.sensor = views("[[0, 0], [45, 180]]");
  scene.sampling = "samples = 65536";
  scene.bands = "response = \"s.tsv\"";
  const SensorResult exact = sensor_result(folder, scene);
  scene.bands = "response = \"s.tsv\"\nstep_nm = 5";  // 36 wavelengths: interactions are counted
  const SensorResult counted = sensor_result(folder, scene, 2);
  scene.bands = "response = \"s.tsv\"\nweighting = \"sampled\"";
  const SensorResult sampled = sensor_result(folder, scene, 3);
  int compared = 0;
  for (std::size_t p = 0; p < exact.parts.size(); ++p) {
    const Part& part = exact.parts[p];
    if (part.order > 4) continue;
    const Estimates& other = part_of(sampled, part.origin, part.component, part.order);
    for (std::size_t i = 0; i < 4; ++i) {
      ++compared;
      EXPECT_LT(std::abs(z_of(exact.radiance[p], i, other, i)), 4.2) << p << ' ' << i;
    }
  }
  EXPECT_GT(compared, 60);  // so many that 4 standard errors happen once in 200 runs of this test
  // 5 nm steps interpolate the response, which shifts the band a little: less than 2 %.
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(counted.radiance[0].value[i] / exact.radiance[0].value[i], 1, 0.02);
}

TEST(Response, RefusesWhatCannotBeABand) {
  const TemporaryFolder folder;
  SceneText scene{.soil = lambertian("0.3"), .sun = sun_at(0, 0), .sampling = "samples = 64"};
  scene.sensor = views("[[0, 0]]");
  const auto refused = [&](const std::string& text, const std::string& bands) -> std::string {
    folder.write("s.csv", text);
    scene.bands = bands;
    try {
      simulation_of(folder, scene);
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  const std::string plain = "response = \"s.csv\"";
  using testing::HasSubstr;
  EXPECT_THAT(refused("650 1\n", plain), HasSubstr("s.csv:1:1: expected a header"));
  EXPECT_THAT(refused("nm,a\n650,1,2\n", plain), HasSubstr("s.csv:2:1: 3 columns, expected 2"));
  EXPECT_THAT(refused("nm,a\n650,1\n640,1\n", plain),
              HasSubstr("s.csv:3:1: wavelength 640 nm does not come after"));
  EXPECT_THAT(refused("nm,a\n650,x\n", plain), HasSubstr("s.csv:2:5: found 'x'"));
  EXPECT_THAT(refused("nm,a\n650,-1\n", plain), HasSubstr("s.csv:2:5: response -1"));
  EXPECT_THAT(refused("um,a\n0.65,1\n", plain), HasSubstr("expected nanometres"));
  EXPECT_THAT(refused("nm,a,b\n650,1,0\n651,1,0\n", plain), HasSubstr("band b responds nowhere"));
  EXPECT_THAT(refused("nm,red\n650,1\n", plain + "\nbands = [\"rde\"]"), HasSubstr("red"));
  EXPECT_THAT(refused("nm,a\n", plain), HasSubstr("no rows"));
}

}  // namespace
}  // namespace bpms::test
