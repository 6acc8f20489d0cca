// A rectangular grid, by its spacing or by the density (then square). In a periodic domain the spacing snaps
// so that whole cells fill it, or the domain's size does. `spacing_m = { mean, sd }` scatters each plant so
// that neighbours' distances have that sd.
#include <cmath>

#include "plant/canopy/pattern.h"

namespace bpms {
namespace {

struct GridOfPlants {
  Eigen::Vector2d spacing_m;
  long long count[2];
};

GridOfPlants fit_grid(double wanted_m, PlantingField& field) {
  GridOfPlants out{{wanted_m, wanted_m}, {}};
  const Eigen::Vector2d before = field.size_m;
  for (int k = 0; k < 2; ++k) {
    const double fit = field.size_m[k] / wanted_m;
    out.count[k] =
        std::max(1LL, field.periodic ? std::llround(fit) : static_cast<long long>(std::floor(fit + 1e-9)));
    if (field.periodic && field.snap_domain) field.size_m[k] = wanted_m * static_cast<double>(out.count[k]);
    if (field.periodic) out.spacing_m[k] = field.size_m[k] / static_cast<double>(out.count[k]);
  }
  if (((field.size_m.array() / before.array()) - 1).abs().maxCoeff() > 1e-9)
    field.notes.push_back(fmt::format(
        "the domain snapped to whole cells of the grid: {:.6g} x {:.6g} m became {:.6g} x {:.6g} m",
        before.x(), before.y(), field.size_m.x(), field.size_m.y()));
  if (((out.spacing_m / wanted_m).array() - 1).abs().maxCoeff() > 1e-9)
    field.notes.push_back(
        fmt::format("grid snapped to the periodic domain: spacing {:.6g} m became {:.6g} m by {:.6g} m",
                    wanted_m, out.spacing_m.x(), out.spacing_m.y()));
  field.snap_domain = false;
  return out;
}

class GridFreedom : public SiteFreedom {
 public:
  GridFreedom(double scatter_m, const PlantingField& field)
      : scatter_m_(scatter_m), field_{field.size_m, field.periodic, Philox(0)} {}
  void add(const Eigen::Vector2d& node) { nodes_.push_back(node); }
  std::optional<Eigen::Vector2d> again(std::size_t i, Philox& random) override {
    if (scatter_m_ == 0) return std::nullopt;
    const double aside = random.normal();
    const Eigen::Vector2d xy = nodes_[i] + scatter_m_ * Eigen::Vector2d(aside, random.normal());
    if (field_.periodic) return field_.wrapped(xy);
    return field_.holds(xy) ? std::optional(xy) : std::nullopt;
  }

 private:
  double scatter_m_;
  PlantingField field_;
  std::vector<Eigen::Vector2d> nodes_;
};

}  // namespace

std::vector<PlantingSite> plant_regular(const TomlValue& planting, PlantingField& field) {
  const TomlValue spacing_key = planting.get("spacing_m");
  const TomlValue density_key = planting.get("density_per_m2");
  if (static_cast<bool>(spacing_key) == static_cast<bool>(density_key))
    planting.reject_choice("expected one of density_per_m2 and spacing_m");
  const MeanSd wanted =
      spacing_key ? positive_mean_sd(spacing_key) : MeanSd{1 / std::sqrt(density_key.positive()), 0};
  field.plant_count(field.area_m2() / (wanted.mean * wanted.mean), spacing_key ? spacing_key : density_key);
  const GridOfPlants grid = fit_grid(wanted.mean, field);
  if (density_key) field.wanted = density_key.positive() * field.area_m2();
  const double scatter = wanted.sd / std::sqrt(2.0);
  auto freedom = field.want_freedom ? std::make_unique<GridFreedom>(scatter, field) : nullptr;
  std::vector<PlantingSite> out;
  for (long long j = 0; j < grid.count[1]; ++j) {
    for (long long i = 0; i < grid.count[0]; ++i) {
      const Eigen::Vector2d node =
          Eigen::Vector2d(static_cast<double>(i) + 0.5 * static_cast<double>(1 - grid.count[0]),
                          static_cast<double>(j) + 0.5 * static_cast<double>(1 - grid.count[1]))
              .cwiseProduct(grid.spacing_m);
      const double aside = field.random.normal();
      const Eigen::Vector2d xy = node + scatter * Eigen::Vector2d(aside, field.random.normal());
      if (field.plant(xy, out) && freedom) freedom->add(node);
    }
  }
  field.freedom = std::move(freedom);
  return out;
}

}  // namespace bpms
