// A rectangular grid, by its spacing or by the density (then square). In a periodic domain the spacing snaps
// so that whole cells fill it. `spacing_m = { mean, sd }` scatters each plant so that neighbours' distances
// have that sd.
#include <cmath>

#include "plant/canopy/pattern.h"

namespace bpms {

std::vector<PlantingSite> plant_regular(const TomlValue& planting, PlantingField& field) {
  const TomlValue spacing_key = planting.get("spacing_m");
  const TomlValue density_key = planting.get("density_per_m2");
  if (static_cast<bool>(spacing_key) == static_cast<bool>(density_key))
    planting.reject("expected one of density_per_m2 and spacing_m");
  const MeanSd wanted =
      spacing_key ? positive_mean_sd(spacing_key) : MeanSd{1 / std::sqrt(density_key.positive()), 0};
  if (density_key) field.wanted = density_key.positive() * field.area_m2();
  plant_count(field.area_m2() / (wanted.mean * wanted.mean), spacing_key ? spacing_key : density_key);
  Eigen::Vector2d spacing(wanted.mean, wanted.mean);
  long long count[2];
  for (int k = 0; k < 2; ++k) {
    const double fit = field.size_m[k] / wanted.mean;
    count[k] =
        std::max(1LL, field.periodic ? std::llround(fit) : static_cast<long long>(std::floor(fit + 1e-9)));
    if (field.periodic) spacing[k] = field.size_m[k] / static_cast<double>(count[k]);
  }
  if (((spacing / wanted.mean).array() - 1).abs().maxCoeff() > 1e-9)
    field.notes.push_back(
        fmt::format("grid snapped to the periodic domain: spacing {:.6g} m became {:.6g} m by {:.6g} m",
                    wanted.mean, spacing.x(), spacing.y()));
  const double scatter = wanted.sd / std::sqrt(2.0);
  std::vector<PlantingSite> out;
  for (long long j = 0; j < count[1]; ++j) {
    for (long long i = 0; i < count[0]; ++i) {
      Eigen::Vector2d xy((static_cast<double>(i) + 0.5 * static_cast<double>(1 - count[0])) * spacing.x(),
                         (static_cast<double>(j) + 0.5 * static_cast<double>(1 - count[1])) * spacing.y());
      const double aside = field.random.normal();
      xy += scatter * Eigen::Vector2d(aside, field.random.normal());
      field.plant(xy, out);
    }
  }
  return out;
}

}  // namespace bpms
