#include <algorithm>
#include <cmath>

#include "simulate/output/derived.h"
#include "simulate/output/quantity.h"

namespace bpms {
namespace {

// Beyond the orders kept: what follows the last by a geometric series that falls by `ratio`.
constexpr int deepest_order = 10'000;

int enough_of(const std::vector<double>& orders, double ratio, double error) {
  // The last entry holds the sum of all orders from its own.
  double tail = 0;
  int enough = 0;
  for (std::size_t n = orders.size(); n-- > 0;) {
    tail += orders[n];
    if (tail > error) {
      enough = static_cast<int>(n) + 1;
      break;
    }
  }
  if (enough < static_cast<int>(orders.size())) return std::max(1, enough);
  if (!(ratio < 1)) return 0;
  double rest = orders.back() * ratio;
  while (rest > error && enough < deepest_order) rest *= ratio, ++enough;
  return rest > error ? 0 : enough;
}

}  // namespace

std::vector<OrderDecay> order_decay(const Simulation& simulation, const SensorResult& result) {
  const std::vector<std::size_t> parts = parts_with(result, Origin::total, Component::all, true);
  if (parts.size() < 2) return {};
  const std::size_t bands = simulation.bands.written(), orders = parts.size();
  const std::vector<double> scale = reflectance_scale(simulation, Origin::total);
  std::vector<OrderDecay> out(bands);
  std::size_t traced = 0;
  for (const std::uint64_t samples : result.samples) traced += samples > 0;
  if (traced == 0) return {};
  for (std::size_t band = 0; band < bands; ++band) {
    OrderDecay& decay = out[band];
    for (const std::size_t part : parts) {
      double sum = 0, squares = 0;
      for (std::size_t view = 0; view < result.samples.size(); ++view) {
        if (result.samples[view] == 0) continue;
        sum += result.radiance[part].value[view * bands + band];
        squares += std::pow(result.radiance[part].standard_error[view * bands + band], 2);
      }
      decay.value.push_back(sum / static_cast<double>(traced) * scale[band]);
      decay.standard_error.push_back(std::sqrt(squares) / static_cast<double>(traced) * scale[band]);
    }
    for (std::size_t n = 0; n + 2 < orders; ++n) {
      const double a = decay.value[n], b = decay.value[n + 1], r = a > 0 ? b / a : no_value;
      decay.ratio.push_back(r);
      // Of independent orders: those of a path are positively correlated, which makes it smaller.
      decay.ratio_standard_error.push_back(
          std::hypot(decay.standard_error[n + 1] / a, r * decay.standard_error[n] / a));
    }
    const double ratio = decay.ratio.empty() ? no_value : decay.ratio.back();
    int enough = 1;
    bool known = true;
    for (std::size_t view = 0; view < result.samples.size() && known; ++view) {
      if (result.samples[view] == 0) continue;
      std::vector<double> own;
      for (const std::size_t part : parts) own.push_back(result.radiance[part].value[view * bands + band]);
      const int needed = enough_of(own, ratio, result.radiance.front().standard_error[view * bands + band]);
      known = needed > 0;
      enough = std::max(enough, needed);
    }
    if (known) decay.enough_order = enough;
  }
  return out;
}

}  // namespace bpms
