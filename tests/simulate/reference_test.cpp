// Canopies with published or independent references: chi-square over the views, both errors taken in.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "core/csv.h"
#include "core/text.h"
#include "core/units.h"
#include "tests/simulate/scene_text.h"

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

}  // namespace
}  // namespace bpms::test
