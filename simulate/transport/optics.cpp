#include "simulate/transport/optics.h"

#include <algorithm>
#include <numeric>

namespace bpms {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// All bands, or guides: the band of strongest scattering and evenly spread ones.
std::vector<std::size_t> lane_bands(const Optics& optics) {
  std::vector<std::size_t> out;
  if (optics.bands <= lanes) {
    for (std::size_t band = 0; band < optics.bands; ++band) out.push_back(band);
    return out;
  }
  std::size_t strongest = 0;
  double most = -1;
  for (std::size_t band = 0; band < optics.bands; ++band) {
    double sum = 0;
    for (const auto& spectrum : optics.spectra) sum += spectrum[band];
    if (sum > most) {
      most = sum;
      strongest = band;
    }
  }
  out.push_back(strongest);
  for (std::size_t i = 0; i + 1 < lanes; ++i) out.push_back(i * (optics.bands - 1) / (lanes - 2));
  return out;
}

// What part of the light goes which way decides how often a path goes there.
SurfaceOptics make_surface(const Material& material, const Simulation& simulation, Optics& optics) {
  SurfaceOptics out;
  out.opaque = material.opaque;
  out.diffuse = material.lobes.empty();
  out.lets_through = simulation.sampling.attenuate_shadows && !material.opaque;
  std::array<double, 2> all{};
  std::vector<std::array<double, 2>> strength;
  for (const SurfaceLobe& lobe : material.lobes) {
    LobeOptics made{lobe.lobe.get(), no_factor, lobe.on_face};
    if (!lobe.spectrum.empty()) {
      made.factor = static_cast<Factor>(optics.spectra.size());
      optics.spectra.push_back(lobe.spectrum);
    }
    out.lobes.push_back(made);
    out.lets_through = out.lets_through || lobe.lobe->is_straight();
    const double albedo = static_cast<double>(lobe.lobe->typical_albedo()) *
                          (lobe.spectrum.empty() ? 1.0 : mean(lobe.spectrum));
    auto& by_face = strength.emplace_back();
    for (std::size_t face = 0; face < 2; ++face) by_face[face] = lobe.on_face[face] ? albedo : 0.0;
    for (std::size_t face = 0; face < 2; ++face) all[face] += by_face[face];
  }
  for (std::size_t face = 0; face < 2; ++face) {
    const double r = mean(material.reflectance[face]), t = mean(material.transmittance);
    out.reflect_share[face] = r + t > 0 ? static_cast<float>(r / (r + t)) : 1.0f;
    const double sum = all[face] + r + t;
    out.diffuse_share[face] = sum > 0 ? static_cast<float>((r + t) / sum) : 1.0f;
    all[face] = sum;
  }
  for (const auto& by_face : strength) {
    auto& share = out.lobe_share.emplace_back();
    for (std::size_t face = 0; face < 2; ++face)
      share[face] = all[face] > 0 ? static_cast<float>(by_face[face] / all[face]) : 0.0f;
  }
  return out;
}

Carriage choose_carriage(const Simulation& simulation, const Optics& optics) {
  if (simulation.bands.sampled) return Carriage::sampled;
  bool separable =
      !simulation.sampling.attenuate_shadows && !(simulation.light.sky && simulation.light.sky->map);
  for (const SurfaceOptics& surface : optics.surfaces)
    for (const LobeOptics& lobe : surface.lobes) separable = separable && lobe.factor != no_factor;
  if (separable && simulation.sampling.keep_interactions) return Carriage::counted;
  if (optics.bands <= lanes) return Carriage::carried;
  return separable ? Carriage::counted : Carriage::spectrum;
}

}  // namespace

Optics make_optics(const Simulation& simulation) {
  Optics out;
  out.bands = simulation.bands.count();
  for (const Material& material : simulation.materials) {
    for (const auto& reflectance : material.reflectance) out.spectra.push_back(reflectance);
    out.spectra.push_back(material.transmittance);
  }
  for (const Material& material : simulation.materials) {
    out.surfaces.push_back(make_surface(material, simulation, out));
    out.lets_through = out.lets_through || out.surfaces.back().lets_through;
    out.needs_uv = out.needs_uv || material.map || material.bump;
  }
  out.carriage = choose_carriage(simulation, out);
  out.lane_bands = lane_bands(out);
  for (const auto& spectrum : out.spectra) {
    Lanes factor;
    for (std::size_t lane = 0; lane < out.lane_bands.size(); ++lane)
      factor.value[lane] = static_cast<float>(spectrum[out.lane_bands[lane]]);
    out.factors.push_back(factor);
  }
  if (out.carriage == Carriage::spectrum || out.carriage == Carriage::sampled) {
    for (const auto& spectrum : out.spectra) {
      auto& single = out.single.emplace_back(std::max(lanes, spectrum.size()), 0.0f);
      std::transform(spectrum.begin(), spectrum.end(), single.begin(),
                     [](double v) { return static_cast<float>(v); });
    }
  }
  return out;
}

}  // namespace bpms
