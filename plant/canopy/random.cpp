// Plants anywhere, independently of each other; their number is the density times the area, rounded.
#include "plant/canopy/pattern.h"

namespace bpms {
namespace {

class AnyPlace : public SiteFreedom {
 public:
  explicit AnyPlace(const PlantingField& field) : field_{field.size_m, field.periodic, Philox(0)} {}
  std::optional<Eigen::Vector2d> again(std::size_t, Philox& random) override {
    return field_.anywhere(random);
  }

 private:
  PlantingField field_;
};

}  // namespace

std::vector<PlantingSite> plant_random(const TomlValue& planting, PlantingField& field) {
  const TomlValue density = planting.require("density_per_m2");
  std::vector<PlantingSite> out(field.plant_count(density.positive() * field.area_m2(), density));
  for (PlantingSite& site : out) site.xy_m = field.anywhere();
  if (field.want_freedom) field.freedom = std::make_unique<AnyPlace>(field);
  return out;
}

}  // namespace bpms
