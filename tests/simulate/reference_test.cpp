// Canopies with published or independent references: chi-square over the views, both errors taken in.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "core/csv.h"
#include "core/text.h"
#include "core/units.h"
#include "tests/simulate/scene_text.h"
#include "tests/simulate/spread.h"

namespace bpms::test {
namespace {

// The value that a chi-square variable with n degrees of freedom exceeds with probability 1 % (Wilson &
// Hilferty).
double chi2_99(double n) {
  constexpr double z = 2.326;
  return n * std::pow(1 - 2 / (9 * n) + z * std::sqrt(2 / (9 * n)), 3);
}

std::string without_comments(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (text[at] != '#') out += text.substr(at, end + 1 - at);
    at = end + 1;
  }
  return out;
}

TEST(Reference, HomogeneousDiscCanopyInRedAndNearInfrared) {
  BPMS_NEED_DATA("bench_hom/hom_discs.def.gz");
  const std::string data = std::filesystem::absolute(data_folder()).string() + "/bench_hom/";
  const CsvTable reference =
      CsvTable::parse("reference_brf.csv", without_comments(read_text(data + "reference_brf.csv")));
  std::string angles;
  for (std::size_t row = 0; row < reference.rows(); ++row)
    angles += std::string(reference.text(row, 0)) + ", ";
  const TemporaryFolder folder;
  const SceneText scene{
      .domain = "size_m = [25, 25]",
      .leaf = bilambertian("[[650, 0.0546], [850, 0.4957]]", "[[650, 0.0149], [850, 0.4409]]"),
      .soil = lambertian("[[650, 0.127], [850, 0.159]]"),
      .discs = data + "hom_discs.def.gz",
      .sun = sun_at(20, 0),
      .sensor = principal_plane("[" + angles + "]"),
      .wavelengths_nm = "[650, 850]",
      .sampling = "samples = 65536"};
  const SensorResult result = sensor_result(folder, scene, 11);
  for (const int band : {0, 1}) {
    double chi2 = 0;
    for (std::size_t view = 0; view < reference.rows(); ++view) {
      const double value = result.radiance[0].value[2 * view + static_cast<std::size_t>(band)];
      const double error = result.radiance[0].standard_error[2 * view + static_cast<std::size_t>(band)];
      const double z = (value - reference.number(view, 1 + 2 * band)) /
                       std::hypot(error, reference.number(view, 2 + 2 * band));
      chi2 += z * z;
      EXPECT_LT(std::abs(z), 4) << "band " << band << " vza " << reference.text(view, 0) << ": " << value;
    }
    EXPECT_LT(chi2, chi2_99(static_cast<double>(reference.rows()))) << "band " << band;
    RecordProperty(fmt::format("chi2_band_{}", band), fmt::format("{:.2f}", chi2));
  }
}

TEST(Reference, RamiHet01InTheNearInfrared) {
  BPMS_NEED_DATA("rami/het01/het01_UNI_sphere.def");
  const std::string data = std::filesystem::absolute(data_folder()).string() + "/rami/het01/";
  const CsvTable reference =
      CsvTable::parse("het01_brfpp_ref.csv", without_comments(read_text(data + "het01_brfpp_ref.csv")));
  const TemporaryFolder folder;
  const SceneText scene{.domain = "size_m = [100, 100]\nazimuth_convention = \"east_counterclockwise\"",
                        .leaf = bilambertian("0.4957", "0.4409"),
                        .soil = lambertian("0.159"),
                        .discs = data + "het01_UNI_sphere.def",
                        .positions = "\"" + data + "het01_UNI_instances.def\"",
                        .sun = sun_at(20, 0),
                        .sensor = principal_plane("{ from = -75, to = 75, step = 2 }"),
                        .sampling = "samples = 16384"};
  const SensorResult result = sensor_result(folder, scene, 11);
  ASSERT_EQ(reference.rows(), result.samples.size());
  // The reference's radiance variance becomes a BRF's by (pi / E)^2 = (brf / radiance)^2.
  double chi2 = 0;
  for (std::size_t view = 0; view < reference.rows(); ++view) {
    const double brf = reference.number(view, reference.require("brf"));
    const double scale = brf / reference.number(view, reference.require("radiance"));
    const double reference_error =
        scale * std::sqrt(reference.number(view, reference.require("radiance_var")));
    const double z = (result.radiance[0].value[view] - brf) /
                     std::hypot(result.radiance[0].standard_error[view], reference_error);
    chi2 += z * z;
  }
  EXPECT_LT(chi2, chi2_99(static_cast<double>(reference.rows())));
  RecordProperty("chi2", fmt::format("{:.2f}", chi2));
}

// The albedo of canopies of discs, all orders, as their radius goes to 0: by reciprocity what one view
// gathers from an isotropic sky. Three radii 4r, 2r, r give f(0) = f(4r) / 3 - 2 f(2r) + 8 f(r) / 3 where f
// is a parabola; the spread between canopies is the error of each.
void expect_turbid_albedo(const std::string& name, const std::string& reflectance,
                          const std::string& transmittance, const std::string& soil, double lai, double sza) {
  const CsvTable table = CsvTable::parse(
      "fluxes.csv", without_comments(read_text(data_folder() + "/analytic/turbid_1d_mc_fluxes.csv")));
  std::size_t row = 0;
  while (row < table.rows() && table.text(row, 0) != name) ++row;
  ASSERT_LT(row, table.rows()) << name;
  const double expected = table.number(row, table.require("albedo")),
               expected_error = table.number(row, table.require("albedo_se"));
  constexpr int canopies = 6;
  const auto albedo = [&](double radius_m) {
    std::vector<double> draws;
    for (std::uint64_t seed = 1; seed <= canopies; ++seed) {
      const TemporaryFolder folder;
      SceneText scene = canopy_text(
          folder, {.lai = lai, .radius_m = radius_m, .size_m = {2, 2}, .bottom_m = 0.04, .seed = seed});
      scene.leaf = bilambertian(reflectance, transmittance);
      scene.soil = lambertian(soil);
      scene.sky = white_sky;
      scene.sensor = views(fmt::format("[[{}, {}]]", sza, 40.0 * static_cast<double>(seed)));
      scene.sampling = "samples = 65536";
      draws.push_back(sensor_result(folder, scene, seed).radiance[0].value[0]);
    }
    return mean_of(draws);
  };
  const Mean wide = albedo(0.04), middle = albedo(0.02), narrow = albedo(0.01);
  const double value = wide.value / 3 - 2 * middle.value + 8 * narrow.value / 3;
  const double error = std::hypot(wide.error / 3, 2 * middle.error, 8 * narrow.error / 3);
  EXPECT_LT(error, 0.02 * expected);  // small enough to bite
  EXPECT_LT(std::abs(value - expected), 4 * std::hypot(error, expected_error))
      << value << " +- " << error << " (radii: " << wide.value << ", " << middle.value << ", " << narrow.value
      << "), expected " << expected;
  ::testing::Test::RecordProperty("albedo",
                                  fmt::format("{:.5f} +- {:.5f}, expected {:.5f}", value, error, expected));
}

TEST(Reference, DiscsTendToTheTurbidMediumInTheNearInfrared) {
  BPMS_NEED_DATA("analytic/turbid_1d_mc_fluxes.csv");
  expect_turbid_albedo("HOM03_TUR_UNI_NIR_20", "0.4957", "0.4409", "0.159", 3, 20);
}

// Myneni et al. 1988: albedo 0.0988 of LAI 4 under a sun at 60 degrees.
TEST(Reference, DiscsTendToTheTurbidMediumOfMyneni) {
  BPMS_NEED_DATA("analytic/turbid_1d_mc_fluxes.csv");
  expect_turbid_albedo("MYNENI88B", "0.175", "0.175", "0.2", 4, 60);
}

}  // namespace
}  // namespace bpms::test
