// The measured wheat midribs of Grignon 2010, family by family: residual and tip error in percent of the
// length, how often a family has the best AICc, processor time of a leaf over that of p:3, and threads' gain.
//   bench_midribs [DATA_FOLDER]
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <vector>

#include "core/parallel.h"
#include "fit/fit.h"
#include "fit/polyline_table.h"

namespace {

using namespace bpms;
using Clock = std::chrono::steady_clock;

double quantile(std::vector<double> values, double q) {
  const auto at = static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct Family {
  std::string name;
  std::vector<OrganFit> fits;
  double seconds = 0;
};

Family fit_family(const std::string& name, const std::vector<MeasuredOrgan>& organs) {
  FitOptions options;
  options.functions = parse_function_request(name);
  const double start = processor_seconds();
  Family out{name, fit_organs(organs, options), 0};
  out.seconds = processor_seconds() - start;
  return out;
}

double wall_seconds(int thread_count, const std::vector<MeasuredOrgan>& organs) {
  set_threads(thread_count);
  const auto start = Clock::now();
  fit_family("p:3", organs);
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

int main(int argc, char** argv) {
  const std::string data = argc > 1 ? argv[1] : std::string(BPMS_SOURCE_DIR) + "/../shared/data";
  const auto organs = read_polylines(data + "/wheat-echap/architectural_measurements/xydb_Grignon2010.csv",
                                     parse_polyline_columns("leaf=variety+inerv,x=x,z=y"), 0.01, {});
  std::vector<Family> families;
  for (const char* name : {"p:3", "n:4", "f:3", "s:4", "p:4", "n:5", "f:4", "s:5"})
    families.push_back(fit_family(name, organs));
  fmt::print("{} leaves\nfamily  rms %: median    p90  tip %: median  best AICc %  ms/leaf  time over p:3\n",
             organs.size());
  for (const Family& family : families) {
    std::vector<double> rms, tip;
    int best = 0;
    for (std::size_t k = 0; k < organs.size(); ++k) {
      const OrganFit& fit = family.fits[k];
      rms.push_back(100 * fit.rms_m / fit.length_m);
      tip.push_back(100 * (fit.fitted_m.back() - fit.points_m.back()).norm() / fit.length_m);
      const double own = fit.functions.at("inclination").aicc;
      best += std::all_of(families.begin(), families.end(), [&](const Family& other) {
        return other.fits[k].functions.at("inclination").aicc >= own;
      });
    }
    const auto count = static_cast<double>(organs.size());
    fmt::print("{:6}  {:13.3f} {:6.3f} {:14.3f} {:12.1f} {:8.2f} {:14.2f}\n", family.name, quantile(rms, 0.5),
               quantile(rms, 0.9), quantile(tip, 0.5), 100 * best / count, 1e3 * family.seconds / count,
               family.seconds / families[0].seconds);
  }
  const double one = wall_seconds(1, organs);
  fmt::print("p:3, wall time on one thread over two: {:.2f}\n", one / wall_seconds(2, organs));
}
