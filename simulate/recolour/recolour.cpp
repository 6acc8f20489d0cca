#include "simulate/recolour/recolour.h"

#include <algorithm>
#include <cmath>

#include "core/interrupt.h"
#include "core/parallel.h"
#include "core/text.h"
#include "simulate/transport/estimate.h"
#include "simulate/transport/optics.h"

namespace bpms {
namespace {

// The means of each batch from a view's histogram, as tracing with these spectra would have left them.
std::vector<BatchMeans> means_of(const InteractionHistogram& histogram, const Optics& optics,
                                 const Rows& rows) {
  std::vector<BatchMeans> out(histogram.batches);
  for (BatchMeans& batch : out) batch.reset(rows, optics.bands);
  std::vector<double> value(optics.bands);
  for (std::size_t n = 0; n < histogram.nodes(); ++n) {
    std::fill(value.begin(), value.end(), 1.0);
    int order = 0;
    for (std::size_t f = 0; f < histogram.factors; ++f) {
      const int exponent = histogram.exponents[n * histogram.factors + f];
      order += exponent;
      for (int k = 0; k < exponent; ++k)
        for (std::size_t b = 0; b < optics.bands; ++b) value[b] *= optics.spectra[f][b];
    }
    order = rows.kept(order);
    for (std::size_t kind = 0; kind < histogram.sums_per_node; ++kind) {
      const std::size_t row =
          kind <= rows.suns ? rows.sun(order, kind) : rows.ground_single(kind - rows.suns - 1);
      for (std::size_t batch = 0; batch < histogram.batches; ++batch) {
        const double sum = histogram.sums[(n * histogram.sums_per_node + kind) * histogram.batches + batch];
        if (sum == 0) continue;
        double* to = out[batch].row(row);
        for (std::size_t b = 0; b < optics.bands; ++b) to[b] += sum * value[b];
      }
    }
  }
  return out;
}

// The same of the derivative by one factor: exponent * (the monomial with one such factor less).
InteractionHistogram derived(const InteractionHistogram& histogram, std::size_t factor) {
  InteractionHistogram out = histogram;
  for (std::size_t n = 0; n < out.nodes(); ++n) {
    std::uint16_t& exponent = out.exponents[n * out.factors + factor];
    double by = 0;
    if (exponent > 0) by = exponent--;
    for (std::size_t k = 0; k < out.sums_per_node * out.batches; ++k)
      out.sums[n * out.sums_per_node * out.batches + k] *= by;
  }
  return out;
}

void require_same_ways(const Recording& recording, const Simulation& with) {
  const std::vector<std::string> names = factor_names(recording.simulation);
  const Optics traced = make_optics(recording.simulation), now = make_optics(with);
  if (now.spectra.size() != traced.spectra.size())
    fail(ErrorKind::bad_input, {}, "the materials have {} spectra, those that were traced {}",
         now.spectra.size(), traced.spectra.size());
  const auto any = [](const std::vector<double>& spectrum) {
    return std::any_of(spectrum.begin(), spectrum.end(), [](double v) { return v > 0; });
  };
  for (std::size_t f = 0; f < names.size(); ++f)
    if (any(now.spectra[f]) && !any(traced.spectra[f]))
      fail(ErrorKind::bad_input, {},
           "{} was 0 when the paths were traced, so that none went that way: expected 0, or trace again",
           names[f]);
}

// Light at other wavelengths: linear in between, never extrapolated; what is flat stays so.
std::vector<double> light_at(const std::vector<double>& light, const std::vector<double>& nm,
                             const Bands& bands, const TomlValue& table) {
  if (std::all_of(light.begin(), light.end(), [&](double v) { return v == light.front(); }))
    return std::vector<double>(bands.count(), light.front());
  std::vector<double> out;
  for (const double at : bands.wavelengths_nm) {
    const auto above = std::lower_bound(nm.begin(), nm.end(), at);
    if (above == nm.end() || at < nm.front())
      table.reject(fmt::format("the light was traced from {} to {} nm, which does not hold {} nm", nm.front(),
                               nm.back(), at));
    const auto i = static_cast<std::size_t>(above - nm.begin());
    const double t = *above == at ? 1 : (at - nm[i - 1]) / (nm[i] - nm[i - 1]);
    out.push_back(t == 1 ? light[i] : light[i - 1] + t * (light[i] - light[i - 1]));
  }
  return out;
}

}  // namespace

Simulation recoloured_simulation(const Recording& recording, const std::string& path) {
  const Simulation& traced = recording.simulation;
  const TomlDocument document = TomlDocument::read(path);
  const TomlValue root = document.root();
  Simulation out;
  out.scene.domain = traced.scene.domain;
  out.scene.materials = traced.scene.materials;
  out.inputs.push_back(path);
  out.bands = traced.bands;
  const TomlValue bands = root.get("bands");
  if (bands) out.bands = read_bands(bands, out.inputs);
  const TomlValue materials = root.require("materials");
  for (const std::string& name : materials.keys())
    if (std::find(traced.scene.materials.begin(), traced.scene.materials.end(), name) ==
        traced.scene.materials.end())
      materials.require(name).reject(
          fmt::format("nothing that was traced is of material {}", in_quotes(name)));
  MaterialContext context(materials, out.bands, out.inputs);
  for (const Material& material : traced.materials) {
    if (materials.has(material.name)) {
      out.materials.push_back(context.material(material.name, materials.require(material.name)));
    } else if (bands) {
      materials.reject(fmt::format("no [materials.{}]: with other [bands] each material needs its spectra",
                                   material.name));
    } else {
      out.materials.push_back(material);
    }
  }
  out.light = traced.light;
  if (bands) {
    const auto& nm = traced.bands.wavelengths_nm;
    for (Sun& sun : out.light.suns) sun.irradiance = light_at(sun.irradiance, nm, out.bands, bands);
    if (out.light.sky) out.light.sky->radiance = light_at(out.light.sky->radiance, nm, out.bands, bands);
  }
  document.finish();
  require_same_ways(recording, out);
  return out;
}

Result recolour(const Recording& recording, const Simulation& with, Derivatives* derivatives) {
  Result out;
  out.seed = recording.seed;
  out.stopped_by = recording.stopped_by;
  out.threads = threads();
  Simulation exact;  // spectra as they are: no band is sampled
  exact.bands = with.bands;
  exact.bands.sampled = false;
  exact.materials = with.materials;
  exact.light = with.light;
  const Optics optics = make_optics(exact);
  const Sources sources(exact);
  const std::size_t bands = with.bands.written();
  if (derivatives != nullptr) derivatives->factors = factor_names(with);
  for (const SensorResult& recorded : recording.sensors) {
    int highest = 1;
    for (const InteractionHistogram& view : recorded.histograms)
      for (std::size_t n = 0; n < view.nodes(); ++n) {
        int order = 0;
        for (std::size_t f = 0; f < view.factors; ++f) order += view.exponents[n * view.factors + f];
        highest = std::max(highest, order);
      }
    constexpr int few_orders = 10;
    const Rows rows{with.light.suns.size(), std::min(few_orders, highest)};
    SensorResult result = recorded;
    result.parts = parts_of(with.light, rows.orders);
    result.radiance.assign(result.parts.size(), {});
    for (Estimates& part : result.radiance) part.resize(recorded.samples.size() * bands);
    if (!with.light.suns.empty() && with.light.sky)
      result.direct_diffuse_covariance.assign(recorded.samples.size() * bands, 0.0);
    Estimates slopes;
    const std::size_t factors = derivatives != nullptr ? derivatives->factors.size() : 0;
    slopes.resize(recorded.samples.size() * bands * factors);
    parallel_for(recorded.samples.size(), [&](std::size_t view) {
      throw_if_interrupted();
      if (recorded.samples[view] == 0) return;
      write_light(means_of(recorded.histograms[view], optics, rows), sources, view, result);
      for (std::size_t f = 0; f < factors; ++f) {
        const auto means = means_of(derived(recorded.histograms[view], f), optics, rows);
        Moments moments(bands);
        std::vector<double> value(bands);
        for (std::size_t batch = 0; batch < means.size(); ++batch) {
          part_of_batch({}, means[batch], sources, value);
          for (std::size_t b = 0; b < bands; ++b) moments.add(b, value[b], batch);
        }
        for (std::size_t b = 0; b < bands; ++b) {
          const std::size_t at = (view * bands + b) * factors + f;
          slopes.value[at] = moments.mean(b);
          slopes.standard_error[at] = moments.standard_error(b, means.size());
        }
      }
    });
    if (derivatives != nullptr) derivatives->by_sensor.push_back(std::move(slopes));
    for (const std::uint64_t n : result.samples) out.samples += n;
    result.histograms.clear();
    out.sensors.push_back(std::move(result));
  }
  return out;
}

}  // namespace bpms
