#include "simulate/transport/estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"

namespace bpms {

std::vector<Part> parts_of(const Light& light, int orders) {
  const bool both = !light.suns.empty() && light.sky;
  std::vector<Part> out{{Origin::total, Component::all, every_order}};
  std::vector<Origin> origins{Origin::total};
  if (both) {
    origins = {Origin::total, Origin::direct, Origin::diffuse};
    out.push_back({Origin::direct, Component::all, every_order});
    out.push_back({Origin::diffuse, Component::all, every_order});
  }
  if (orders == 0) return out;
  if (!light.suns.empty())
    for (const Component component : {Component::uc_sgl, Component::co_sgl, Component::mlt})
      out.push_back({both ? Origin::direct : Origin::total, component, every_order});
  for (int order = 1; order <= orders; ++order)
    for (const Origin origin : origins) out.push_back({origin, Component::all, order});
  return out;
}

void part_of_batch(const Part& part, const BatchMeans& means, const Light& light, std::span<double> out) {
  std::fill(out.begin(), out.end(), 0.0);
  const auto add = [&](std::size_t row, double sign) {
    const double* from = means.row(row);
    const bool from_sky = row == BatchMeans::sky_seen || (row >= 2 && row % 2 == 1);
    for (std::size_t band = 0; band < out.size(); ++band) {
      const double source = from_sky ? (light.sky ? light.sky->radiance[band] : 0.0)
                                     : (!light.suns.empty() ? light.suns.front().irradiance[band] : 0.0);
      out[band] += sign * source * from[band];
    }
  };
  const auto add_order = [&](int order) {
    if (part.origin != Origin::diffuse && !light.suns.empty()) add(BatchMeans::sun(order), 1);
    if (part.origin != Origin::direct && light.sky) add(BatchMeans::sky(order), 1);
  };
  switch (part.component) {
    case Component::uc_sgl:
      add(BatchMeans::ground_single, 1);
      return;
    case Component::co_sgl:
      add(BatchMeans::sun(1), 1);
      add(BatchMeans::ground_single, -1);
      return;
    case Component::mlt:
      for (int order = 2; order <= means.orders; ++order) add(BatchMeans::sun(order), 1);
      return;
    case Component::all:
      break;
  }
  if (part.order != every_order) {
    add_order(part.order);
    return;
  }
  for (int order = 1; order <= means.orders; ++order) add_order(order);
  if (part.origin != Origin::direct && light.sky) add(BatchMeans::sky_seen, 1);
}

double reached(const std::vector<BatchMeans>& means, const Light& light, const Sampling& sampling) {
  const std::size_t bands = means.front().bands;
  Moments moments(bands);
  std::vector<double> value(bands);
  for (std::size_t batch = 0; batch < means.size(); ++batch) {
    part_of_batch({}, means[batch], light, value);
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

namespace {

void write_fractions(const std::vector<const ViewCounts*>& counts, std::size_t view, SensorResult& result) {
  const std::size_t materials = counts.front()->sunlit.size();
  const auto write = [&](Estimates& to, std::size_t index, auto count_of) {
    Moments moments(1);
    for (std::size_t batch = 0; batch < counts.size(); ++batch)
      moments.add(0,
                  static_cast<double>(count_of(*counts[batch])) / static_cast<double>(counts[batch]->paths),
                  batch);
    to.value[index] = moments.mean(0);
    to.standard_error[index] = moments.standard_error(0, counts.size());
  };
  write(result.gap, view, [](const ViewCounts& c) { return c.gap; });
  for (std::size_t m = 0; m < materials; ++m) {
    write(result.sunlit, view * materials + m, [m](const ViewCounts& c) { return c.sunlit[m]; });
    write(result.shaded, view * materials + m, [m](const ViewCounts& c) { return c.shaded[m]; });
  }
}

}  // namespace

void write_estimates(const std::vector<BatchMeans>& means, const std::vector<const ViewCounts*>& counts,
                     const Light& light, std::size_t view, SensorResult& result) {
  const std::size_t bands = means.front().bands;
  std::vector<double> value(bands);
  for (std::size_t p = 0; p < result.parts.size(); ++p) {
    Moments moments(bands);
    for (std::size_t batch = 0; batch < means.size(); ++batch) {
      part_of_batch(result.parts[p], means[batch], light, value);
      for (std::size_t band = 0; band < bands; ++band) moments.add(band, value[band], batch);
    }
    for (std::size_t band = 0; band < bands; ++band) {
      result.radiance[p].value[view * bands + band] = moments.mean(band);
      result.radiance[p].standard_error[view * bands + band] = moments.standard_error(band, means.size());
    }
  }
  write_fractions(counts, view, result);
  result.samples[view] = 0;
  for (const ViewCounts* count : counts) result.samples[view] += count->paths;
}

void write_truncation(const Sampling& sampling, std::size_t bands, SensorResult& result) {
  const auto part = [&](int order) -> const Estimates* {
    for (std::size_t p = 0; p < result.parts.size(); ++p)
      if (result.parts[p].order == order && result.parts[p].origin == Origin::total)
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

}  // namespace bpms
