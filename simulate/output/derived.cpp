#include "simulate/output/derived.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "simulate/output/quantity.h"

namespace bpms {
namespace {

bool has_gaps(const Simulation& simulation, const Result& result, std::size_t sensor) {
  return simulation.scene.domain.periodic && !result.sun_gap.value.empty() &&
         result.sensors[sensor].sensor->type == "brf";
}

double ground_area_m2(const Scene& scene) {
  return scene.domain.size_m.x() * scene.domain.size_m.y();
}

double view_cosine(const SensorResult& result, std::size_t view) {
  return std::cos(radians(result.sensor->vza_deg(view)));
}

// A gap probability of 0 or 1 has no logarithm to speak of.
bool between(double p) {
  return p > 0 && p < 1;
}

void set(Estimates& to, std::size_t at, double value, double error) {
  to.value[at] = value;
  to.standard_error[at] = error;
}

// -ln p x scale where p has a logarithm.
void set_logarithm(Estimates& to, std::size_t at, const Estimates& of, double scale, bool known) {
  const double p = of.value[at];
  known = known && between(p);
  set(to, at, known ? -std::log(p) * scale : no_value, known ? of.standard_error[at] / p * scale : no_value);
}

}  // namespace

double intercepting_area_m2(const Scene& scene) {
  double out = 0;
  for (const Instance& instance : scene.instances) {
    const Prototype& prototype = scene.prototypes[instance.prototype];
    double own = 0;
    for (const Disc& disc : prototype.discs) own += pi * disc.radius_m * disc.radius_m;
    for (std::size_t k = 0; k < prototype.shapes.size(); ++k)
      if (prototype.organ_of(k) == no_organ) own += 0.5 * shape_area_m2(prototype.shapes[k]);
    if (prototype.mesh)
      for (const Mesh::Organ& organ : prototype.mesh->organs)
        own += (organ.kind == "leaf" ? 1 : 0.5) * organ.area_m2;
    out += own * instance.scale * instance.scale;
  }
  return out;
}

Estimates overlap_function(const Simulation& simulation, const Result& result, std::size_t sensor) {
  Estimates out;
  if (!has_gaps(simulation, result, sensor)) return out;
  const SensorResult& of = result.sensors[sensor];
  const std::size_t suns = result.sun_gap.value.size();
  out.resize(of.samples.size() * suns);
  for (std::size_t at = 0; at < out.value.size(); ++at) {
    const std::size_t view = at / suns, sun = at % suns;
    if (of.samples[view] == 0) {
      set(out, at, no_value, no_value);
      continue;
    }
    const double p_s = result.sun_gap.value[sun], p_v = of.gap.value[view];
    set(out, at, of.sunlit_ground.value[at] - p_s * p_v,
        std::hypot(of.sunlit_ground.standard_error[at], p_s * of.gap.standard_error[view],
                   p_v * result.sun_gap.standard_error[sun]));
  }
  return out;
}

Estimates effective_g(const Simulation& simulation, const Result& result, std::size_t sensor) {
  Estimates out;
  const double area = intercepting_area_m2(simulation.scene);
  if (!has_gaps(simulation, result, sensor) || !(area > 0)) return out;
  const SensorResult& of = result.sensors[sensor];
  const double per_pai = ground_area_m2(simulation.scene) / area;
  out.resize(of.samples.size());
  for (std::size_t view = 0; view < out.value.size(); ++view)
    set_logarithm(out, view, of.gap, view_cosine(of, view) * per_pai, of.samples[view] > 0);
  return out;
}

Estimates effective_g_of_suns(const Simulation& simulation, const Result& result) {
  Estimates out;
  const double area = intercepting_area_m2(simulation.scene);
  if (!simulation.scene.domain.periodic || !(area > 0)) return out;
  const double per_pai = ground_area_m2(simulation.scene) / area;
  out.resize(result.sun_gap.value.size());
  for (std::size_t sun = 0; sun < out.value.size(); ++sun)
    set_logarithm(out, sun, result.sun_gap, simulation.light.suns[sun].direction.z() * per_pai, true);
  return out;
}

Estimates effective_gamma(const Simulation& simulation, const Result& result, std::size_t sensor) {
  Estimates out;
  const double area = intercepting_area_m2(simulation.scene);
  if (!has_gaps(simulation, result, sensor) || !(area > 0)) return out;
  const SensorResult& of = result.sensors[sensor];
  const double pai = area / ground_area_m2(simulation.scene);
  const std::size_t suns = result.sun_gap.value.size(), bands = simulation.bands.written();
  const Origin origin = simulation.light.sky ? Origin::direct : Origin::total;
  out.value.assign(of.samples.size() * suns * bands, no_value);
  out.standard_error = out.value;
  for (std::size_t sun = 0; sun < suns; ++sun) {
    const int alone = suns > 1 ? static_cast<int>(sun) : every_sun;
    const std::size_t part =
        of.place_of({alone == every_sun ? origin : Origin::direct, Component::co_sgl, every_order, alone});
    if (part == of.parts.size()) return {};
    const std::vector<double> to_brf = reflectance_scale(simulation, Origin::direct, alone);
    const double p_s = result.sun_gap.value[sun], se_s = result.sun_gap.standard_error[sun];
    for (std::size_t view = 0; view < of.samples.size(); ++view) {
      const double p_v = of.gap.value[view], se_v = of.gap.standard_error[view], both = p_s * p_v;
      if (of.samples[view] == 0 || !between(p_s) || !between(p_v)) continue;
      const double path = -std::log(both);
      const double factor =
          simulation.light.suns[sun].direction.z() * view_cosine(of, view) / pai * path / (1 - both);
      // d ln(factor) / d path, and d path = dP / P.
      const double slope = std::abs(1 / path - both / (1 - both));
      for (std::size_t band = 0; band < bands; ++band) {
        const std::size_t from = view * bands + band;
        const double gamma = of.radiance[part].value[from] * to_brf[band] * factor;
        const double se_brf = of.radiance[part].standard_error[from] * to_brf[band] * factor;
        set(out, (view * suns + sun) * bands + band, gamma,
            std::hypot(se_brf + gamma * slope * se_v / p_v, gamma * slope * se_s / p_s));
      }
    }
  }
  return out;
}

Estimates recombined_reflectance(const Simulation& simulation, const SensorResult& result,
                                 const std::vector<double>& diffuse_fraction) {
  Estimates out;
  const std::size_t direct = result.place_of({Origin::direct}), diffuse = result.place_of({Origin::diffuse}),
                    bands = simulation.bands.written();
  if (direct == result.parts.size() || diffuse == result.parts.size() ||
      result.direct_diffuse_covariance.empty())
    return out;
  const std::vector<double> of_direct = reflectance_scale(simulation, Origin::direct),
                            of_diffuse = reflectance_scale(simulation, Origin::diffuse);
  out.resize(result.samples.size() * bands);
  for (std::size_t i = 0; i < out.value.size(); ++i) {
    const std::size_t band = i % bands;
    const double a = (1 - diffuse_fraction[band]) * of_direct[band],
                 b = diffuse_fraction[band] * of_diffuse[band];
    const double variance = std::pow(a * result.radiance[direct].standard_error[i], 2) +
                            std::pow(b * result.radiance[diffuse].standard_error[i], 2) +
                            2 * a * b * result.direct_diffuse_covariance[i];
    const bool known = result.samples[i / bands] > 0;
    set(out, i,
        known ? a * result.radiance[direct].value[i] + b * result.radiance[diffuse].value[i] : no_value,
        known ? std::sqrt(std::max(0.0, variance)) : no_value);
  }
  return out;
}

}  // namespace bpms
