#include "simulate/materials/energy.h"

#include <cmath>

#include "core/units.h"

namespace bpms {
namespace {

// What the albedo is made from: values at one pair of directions.
class BandValues {
 public:
  BandValues(const SurfaceLobe& lobe, std::size_t bands) : lobe_(lobe), values_(bands) {}
  void add(const Eigen::Vector3f& view, const Eigen::Vector3f& light, double weight,
           std::vector<double>& sums) {
    if (lobe_.lobe->separable()) {
      shape_ += weight * static_cast<double>(lobe_.lobe->shape(view, light));
      return;
    }
    lobe_.lobe->values(view, light, values_);
    for (std::size_t band = 0; band < sums.size(); ++band)
      sums[band] += weight * static_cast<double>(values_[band]);
  }
  void finish(std::vector<double>& sums) const {
    if (!lobe_.lobe->separable()) return;
    for (std::size_t band = 0; band < sums.size(); ++band) sums[band] = shape_ * lobe_.spectrum[band];
  }

 private:
  const SurfaceLobe& lobe_;
  std::vector<float> values_;
  double shape_ = 0;
};

// By exchanging light and view: what the lobe's sampling, from the light's direction, would give.
void add_by_sampling(const SurfaceLobe& lobe, const Eigen::Vector3f& from, BandValues& values,
                     std::vector<double>& sums) {
  constexpr int grid = 32;
  for (int i = 0; i < grid; ++i) {
    for (int k = 0; k < grid; ++k) {
      Eigen::Vector3f to;
      if (!lobe.lobe->sample(from, (static_cast<float>(i) + 0.5f) / grid,
                             (static_cast<float>(k) + 0.5f) / grid, to))
        continue;
      const double pdf = static_cast<double>(lobe.lobe->pdf(from, to));
      if (pdf > 0) values.add(from, to, std::abs(static_cast<double>(to.z())) / pdf / (grid * grid), sums);
    }
  }
}

// Reflection without reciprocity: over the views, uniform in azimuth and in cosine squared.
void add_over_views(const Eigen::Vector3f& light, BandValues& values, std::vector<double>& sums) {
  constexpr int zeniths = 32, azimuths = 32;
  for (int i = 0; i < zeniths; ++i) {
    const double cosine = std::sqrt((i + 0.5) / zeniths), sine = std::sqrt(1 - cosine * cosine);
    for (int k = 0; k < azimuths; ++k) {
      const double azimuth = pi * (k + 0.5) / azimuths;  // the other half mirrors it
      const Eigen::Vector3d view(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
      values.add(view.cast<float>(), light, pi / (zeniths * azimuths), sums);
    }
  }
}

constexpr double energy_angles_deg[] = {0, 30, 60, 75, 85};

}  // namespace

std::vector<double> directional_albedo(const SurfaceLobe& lobe, const Eigen::Vector3f& light,
                                       std::size_t bands) {
  std::vector<double> out(bands, 0.0);
  if (lobe.lobe->is_delta()) return lobe.spectrum;
  BandValues values(lobe, bands);
  if (lobe.lobe->reciprocal())
    add_by_sampling(lobe, light, values, out);
  else
    add_over_views(light, values, out);
  values.finish(out);
  return out;
}

void require_energy(Material& material, const TomlValue& table, const Bands& bands) {
  if (material.map) return;  // its materials were looked at
  bool finite = false, empirical = false, same_faces = material.reflectance[0] == material.reflectance[1];
  for (const SurfaceLobe& lobe : material.lobes) {
    finite |= !lobe.lobe->is_delta();
    empirical |= lobe.lobe->empirical();
    same_faces &= lobe.on_face[0] && lobe.on_face[1];
  }
  // Doubles round 0.3 + 0.7 and its like; the albedo of a lobe is good to the other.
  const double rounding = finite ? 1e-3 : 1e-9;
  double worst = 1 + rounding, worst_deg = 0;
  std::size_t worst_band = 0;
  for (int face = 0; face < (same_faces ? 1 : 2); ++face) {
    const std::vector<double>& reflectance = material.reflectance[static_cast<std::size_t>(face)];
    for (const double zenith_deg : energy_angles_deg) {
      const Eigen::Vector3f light(static_cast<float>(std::sin(radians(zenith_deg))), 0,
                                  static_cast<float>(std::cos(radians(zenith_deg))));
      std::vector<double> lobes(bands.count(), 0.0);
      for (const SurfaceLobe& lobe : material.lobes) {
        if (!lobe.on_face[static_cast<std::size_t>(face)]) continue;
        const std::vector<double> albedo = directional_albedo(lobe, light, bands.count());
        for (std::size_t band = 0; band < bands.count(); ++band) lobes[band] += albedo[band];
      }
      for (std::size_t band = 0; band < bands.count(); ++band) {
        const double sum = reflectance[band] + material.transmittance[band] + lobes[band];
        if (!(sum > 1 + rounding)) continue;
        if (!empirical) {
          if (material.lobes.empty())
            table.get("reflectance")
                .reject(
                    fmt::format("reflectance {} + transmittance {} = {} in {}: expected a sum of at most 1",
                                reflectance[band], material.transmittance[band], sum, bands.name(band)));
          table.reject(fmt::format(
              "reflectance {:.6g} + transmittance {:.6g} + lobes {:.6g} = {:.6g} in {}{}: expected a sum of "
              "at most 1",
              reflectance[band], material.transmittance[band], lobes[band], sum, bands.name(band),
              finite ? fmt::format(" for light at {:g} degrees", zenith_deg) : ""));
        }
        if (sum > worst) {
          worst = sum;
          worst_deg = zenith_deg;
          worst_band = band;
        }
      }
      if (!finite) break;  // no angle in it
    }
  }
  if (worst > 1 + rounding)
    material.notes.push_back(fmt::format("{} gives out {:.3f} of what it receives at {:g} degrees in {}",
                                         material.type, worst, worst_deg, bands.name(worst_band)));
}

}  // namespace bpms
