// Views from shared paths against the reference of RAMI HET01: chi-square over the views, both errors and the
// covariance of the views taken in.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/csv.h"
#include "core/text.h"
#include "simulate/forward/shared_views.h"
#include "tests/simulate/scene_text.h"

namespace bpms::test {
namespace {

CsvTable table_without_comments(const std::string& path) {
  const std::string text = read_text(path);
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (text[at] != '#') out += text.substr(at, end + 1 - at);
    at = end + 1;
  }
  return CsvTable::parse(path, out);
}

// The sum of the squares of n standard normal variables with correlations r has the mean n and the variance
// 2 sum(r^2): as much as n/d times chi-square with d = n^2 / sum(r^2) degrees of freedom (Satterthwaite
// 1946).
// Exceeded once in a hundred times (Wilson & Hilferty 1931).
double most_sum_of_squares(double n, double sum_of_correlations_squared) {
  const double freedom = n * n / sum_of_correlations_squared, spread = 2 / (9 * freedom);
  return n * std::pow(1 - spread + 2.326 * std::sqrt(spread), 3);
}

// Neighbouring views of one run have nearly the same errors, and a chi-square of them tells little: each run
// has every sixth view, and a seed of its own.
constexpr std::size_t runs = 6;

TEST(SharedViewsReference, RamiHet01InTheNearInfrared) {
  BPMS_NEED_DATA("rami/het01/het01_UNI_sphere.def");
  const std::string data = std::filesystem::absolute(data_folder()).string() + "/rami/het01/";
  const CsvTable reference = table_without_comments(data + "het01_brfpp_ref.csv");
  const TemporaryFolder folder;
  SceneText scene{.domain = "size_m = [100, 100]\nazimuth_convention = \"east_counterclockwise\"",
                  .leaf = bilambertian("0.4957", "0.4409"),
                  .soil = lambertian("0.159"),
                  .discs = data + "het01_UNI_sphere.def",
                  .positions = "\"" + data + "het01_UNI_instances.def\"",
                  .sun = sun_at(20, 0),
                  .sampling = "samples = 262144"};
  double squares = 0, correlations = 0, sum = 0, sum_variance = 0, most = 0, most_error = 0;
  for (std::size_t run = 0; run < runs; ++run) {
    std::string angles;
    std::vector<std::size_t> rows;
    for (std::size_t row = run; row < reference.rows(); row += runs) {
      rows.push_back(row);
      angles += std::string(reference.text(row, reference.require("vza_deg"))) + ", ";
    }
    scene.sensor = principal_plane("[" + angles + "]");
    const Simulation simulation = simulation_of(folder, scene);
    const Intersector intersector(simulation.scene);
    const SharedViews shared =
        trace_shared_views(simulation, intersector, *simulation.sensors[0], 111 + run, 0);
    const Estimates& total = shared.result.radiance[0];
    const std::size_t views = rows.size();
    ASSERT_EQ(views, total.value.size());
    std::vector<double> variance;  // of the difference
    for (std::size_t v = 0; v < views; ++v) {
      const double brf = reference.number(rows[v], reference.require("brf"));
      // The reference's radiance variance becomes a BRF's by (pi / E)^2 = (brf / radiance)^2.
      const double scale = brf / reference.number(rows[v], reference.require("radiance"));
      const double theirs = scale * scale * reference.number(rows[v], reference.require("radiance_var"));
      variance.push_back(total.standard_error[v] * total.standard_error[v] + theirs);
      const double off = total.value[v] - brf;
      squares += off * off / variance[v];
      most = std::max(most, std::abs(off) / std::sqrt(variance[v]));
      most_error = std::max(most_error, total.standard_error[v] / total.value[v]);
      sum += off, sum_variance += theirs;
    }
    for (std::size_t v = 0; v < views; ++v)
      for (std::size_t w = 0; w < views; ++w) {
        const double both = shared.covariance[v * views + w];
        sum_variance += both;
        // Each squared correlation of 32 batches is too large by 1/31 in the mean, times the square of our
        // part in the variances.
        const double own = shared.covariance[v * views + v] * shared.covariance[w * views + w];
        correlations += v == w ? 1 : (both * both - own / 31) / (variance[v] * variance[w]);
      }
  }
  const auto count = static_cast<double>(reference.rows());
  const double allowed = most_sum_of_squares(count, correlations);
  EXPECT_LT(most_error, 0.005);  // small enough to bite
  EXPECT_GE(correlations, count);
  EXPECT_LT(squares, allowed) << "sum of r^2 " << correlations;
  EXPECT_LT(most, 4.5);
  // The mean over the views is known best. 3.5 of a normal variable: the variances are those of six times 31
  // degrees of freedom.
  EXPECT_LT(std::abs(sum), 3.5 * std::sqrt(sum_variance)) << "the mean is off by " << sum / count;
  RecordProperty("sum_of_squares", fmt::format("{:.1f}", squares));
  RecordProperty("exceeded_once_in_100", fmt::format("{:.1f}", allowed));
  RecordProperty("sum_of_r2", fmt::format("{:.1f}", correlations));
  RecordProperty("largest_z", fmt::format("{:.2f}", most));
  RecordProperty("largest_relative_error", fmt::format("{:.4f}", most_error));
  RecordProperty("z_of_mean", fmt::format("{:.2f}", sum / std::sqrt(sum_variance)));
  RecordProperty("error_of_mean", fmt::format("{:.6f}", std::sqrt(sum_variance) / count));
}

}  // namespace
}  // namespace bpms::test
