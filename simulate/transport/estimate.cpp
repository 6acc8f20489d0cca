#include "simulate/transport/estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bpms {

std::vector<Part> parts_of(const Light& light, int orders) {
  // Whose light is told apart: all of it; of several kinds of sources each; of several suns each.
  std::vector<Part> whose{{}};
  const bool both = !light.suns.empty() && light.sky;
  if (both) {
    whose.push_back({Origin::direct});
    whose.push_back({Origin::diffuse});
  }
  if (light.suns.size() > 1)
    for (std::size_t s = 0; s < light.suns.size(); ++s)
      whose.push_back({Origin::direct, Component::all, every_order, static_cast<int>(s)});
  std::vector<Part> out = whose;
  if (orders == 0) return out;
  for (const Part& part : whose) {
    const bool of_suns = part.origin == Origin::direct || (part.origin == Origin::total && !light.sky);
    if (light.suns.empty() || !of_suns) continue;
    for (const Component component : {Component::uc_sgl, Component::co_sgl, Component::mlt})
      out.push_back({part.origin, component, every_order, part.sun});
  }
  for (int order = 1; order <= orders; ++order)
    for (const Part& part : whose) out.push_back({part.origin, Component::all, order, part.sun});
  return out;
}

Sources::Sources(const Simulation& of) : simulation(&of) {
  for (const Sun& sun : of.light.suns) traced.push_back(sun.irradiance);
  traced.push_back(of.light.sky ? of.light.sky->radiance : std::vector<double>(of.bands.count(), 0.0));
  for (const auto& light : traced) written.push_back(of.bands.integrate(light));
}

void part_of_batch(const Part& part, const BatchMeans& means, const Sources& sources, std::span<double> out) {
  const Rows& rows = means.rows;
  const Bands& bands = sources.simulation->bands;
  std::fill(out.begin(), out.end(), 0.0);
  const auto add = [&](std::size_t source, std::size_t row, double sign) {
    const double* from = means.row(row);
    if (means.of_written_bands || bands.responses.empty()) {
      const std::vector<double>& light = sources.written[source];
      for (std::size_t band = 0; band < out.size(); ++band) out[band] += sign * light[band] * from[band];
      return;
    }
    const std::vector<double>& light = sources.traced[source];
    for (std::size_t band = 0; band < out.size(); ++band) {
      double sum = 0;
      for (const auto& weight : bands.responses[band].weights)
        sum += weight.second * light[weight.first] * from[weight.first];
      out[band] += sign * sum;
    }
  };
  const auto each_sun = [&](auto visit) {
    if (part.origin == Origin::diffuse) return;
    for (std::size_t s = 0; s < rows.suns; ++s)
      if (part.sun == every_sun || static_cast<std::size_t>(part.sun) == s) visit(s);
  };
  const auto add_order = [&](int order) {
    each_sun([&](std::size_t s) { add(s, rows.sun(order, s), 1); });
    if (part.origin != Origin::direct && sources.simulation->light.sky) add(rows.suns, rows.sky(order), 1);
  };
  switch (part.component) {
    case Component::uc_sgl:
      each_sun([&](std::size_t s) { add(s, rows.ground_single(s), 1); });
      return;
    case Component::co_sgl:
      each_sun([&](std::size_t s) {
        add(s, rows.sun(1, s), 1);
        add(s, rows.ground_single(s), -1);
      });
      return;
    case Component::mlt:
      each_sun([&](std::size_t s) {
        for (int order = 2; order <= rows.orders; ++order) add(s, rows.sun(order, s), 1);
      });
      return;
    case Component::all:
      break;
  }
  if (part.order != every_order) {
    add_order(part.order);
    return;
  }
  for (int order = 0; order <= rows.orders; ++order) add_order(order);
}

double reached(const std::vector<BatchMeans>& means, const Sources& sources) {
  const Sampling& sampling = sources.simulation->sampling;
  const std::size_t bands = sources.simulation->bands.written();
  Moments moments(bands);
  std::vector<double> value(bands);
  for (std::size_t batch = 0; batch < means.size(); ++batch) {
    part_of_batch({}, means[batch], sources, value);
    for (std::size_t band = 0; band < bands; ++band) moments.add(band, value[band], batch);
  }
  double worst = std::numeric_limits<double>::infinity();
  for (std::size_t band = 0; band < bands; ++band) {
    const double target =
        sampling.relative ? sampling.target_se * std::abs(moments.mean(band)) : sampling.target_se;
    const double error = moments.standard_error(band, means.size());
    if (error > 0) worst = std::min(worst, target / error);
  }
  return worst;
}

void write_fractions(const std::vector<const ViewCounts*>& counts, std::size_t view, SensorResult& result) {
  const auto write = [&](Estimates& to, std::size_t index, auto count_of) {
    Moments moments(1);
    for (std::size_t batch = 0; batch < counts.size(); ++batch)
      moments.add(0,
                  static_cast<double>(count_of(*counts[batch])) / static_cast<double>(counts[batch]->paths),
                  batch);
    to.value[index] = moments.mean(0);
    to.standard_error[index] = moments.standard_error(0, counts.size());
  };
  const auto write_all = [&](Estimates& to, std::vector<std::uint64_t> ViewCounts::*which) {
    const std::size_t size = (counts.front()->*which).size();
    for (std::size_t i = 0; i < size; ++i)
      write(to, view * size + i, [which, i](const ViewCounts& c) { return (c.*which)[i]; });
  };
  write(result.gap, view, [](const ViewCounts& c) { return c.gap; });
  write_all(result.sunlit, &ViewCounts::sunlit);
  write_all(result.shaded, &ViewCounts::shaded);
  write_all(result.lit_behind, &ViewCounts::lit_behind);
  write_all(result.sunlit_ground, &ViewCounts::sunlit_ground);
  result.samples[view] = 0;
  for (const ViewCounts* count : counts) result.samples[view] += count->paths;
}

namespace {

void write_covariance(const std::vector<BatchMeans>& means, const Sources& sources, std::size_t view,
                      SensorResult& result) {
  const std::size_t bands = sources.simulation->bands.written();
  std::vector<double> direct(bands), diffuse(bands), mean_direct(bands), mean_diffuse(bands), products(bands);
  for (std::size_t batch = 0; batch < means.size(); ++batch) {
    part_of_batch({Origin::direct}, means[batch], sources, direct);
    part_of_batch({Origin::diffuse}, means[batch], sources, diffuse);
    for (std::size_t band = 0; band < bands; ++band) {
      const double off = direct[band] - mean_direct[band], n = static_cast<double>(batch + 1);
      mean_direct[band] += off / n;
      mean_diffuse[band] += (diffuse[band] - mean_diffuse[band]) / n;
      products[band] += off * (diffuse[band] - mean_diffuse[band]);
    }
  }
  const double n = static_cast<double>(means.size());
  for (std::size_t band = 0; band < bands; ++band)
    result.direct_diffuse_covariance[view * bands + band] = products[band] / (n * (n - 1));
}

}  // namespace

void write_light(const std::vector<BatchMeans>& means, const Sources& sources, std::size_t view,
                 SensorResult& result) {
  const std::size_t bands = sources.simulation->bands.written();
  std::vector<double> value(bands);
  for (std::size_t p = 0; p < result.parts.size(); ++p) {
    Moments moments(bands);
    for (std::size_t batch = 0; batch < means.size(); ++batch) {
      part_of_batch(result.parts[p], means[batch], sources, value);
      for (std::size_t band = 0; band < bands; ++band) moments.add(band, value[band], batch);
    }
    for (std::size_t band = 0; band < bands; ++band) {
      result.radiance[p].value[view * bands + band] = moments.mean(band);
      result.radiance[p].standard_error[view * bands + band] = moments.standard_error(band, means.size());
    }
  }
  if (!result.direct_diffuse_covariance.empty()) write_covariance(means, sources, view, result);
}

void write_truncation(const Sampling& sampling, std::size_t bands, SensorResult& result) {
  const auto part = [&](int order) -> const Estimates* {
    for (std::size_t p = 0; p < result.parts.size(); ++p)
      if (result.parts[p].order == order && result.parts[p].origin == Origin::total &&
          result.parts[p].sun == every_sun)
        return &result.radiance[p];
    return nullptr;
  };
  if (sampling.max_order == 0) return;
  result.truncation.assign(result.samples.size() * bands, std::numeric_limits<double>::quiet_NaN());
  const Estimates* last = part(sampling.max_order);
  const Estimates* before = part(sampling.max_order - 1);
  if (last == nullptr || before == nullptr) return;
  for (std::size_t i = 0; i < result.truncation.size(); ++i) {
    const double decay = before->value[i] > 0 ? last->value[i] / before->value[i] : 0.0;
    if (decay < 1) result.truncation[i] = last->value[i] * decay / (1 - decay);
  }
}

void drop_empty_orders(SensorResult& result) {
  int highest = 1;
  for (std::size_t p = 0; p < result.parts.size(); ++p) {
    const auto& values = result.radiance[p].value;
    if (std::any_of(values.begin(), values.end(), [](double v) { return v != 0; }))
      highest = std::max(highest, result.parts[p].order);
  }
  for (std::size_t p = result.parts.size(); p-- > 0;) {
    if (result.parts[p].order <= highest) continue;
    result.parts.erase(result.parts.begin() + static_cast<std::ptrdiff_t>(p));
    result.radiance.erase(result.radiance.begin() + static_cast<std::ptrdiff_t>(p));
  }
}

}  // namespace bpms
