// Random plants no nearer to each other than min_distance_m: random sequential addition (darts), with the
// distance taken around the border in a periodic domain.
#include <cmath>
#include <unordered_map>

#include "core/units.h"
#include "plant/canopy/pattern.h"

namespace bpms {
namespace {

// Sites by cell; cells are at least the distance wide, so that a conflict lies in the neighbouring ones.
class CellGrid {
 public:
  CellGrid(const PlantingField& field, double distance_m) : field_(field), distance_m_(distance_m) {
    for (int k = 0; k < 2; ++k) {
      count_[k] = std::max<long long>(1, static_cast<long long>(field.size_m[k] / distance_m));
      cell_[k] = field.size_m[k] / static_cast<double>(count_[k]);
    }
  }
  bool is_free(const Eigen::Vector2d& xy) const {
    for (long long dy = -1; dy <= 1; ++dy) {
      for (long long dx = -1; dx <= 1; ++dx) {
        const auto found = sites_.find(key(index(xy, 0) + dx, index(xy, 1) + dy));
        if (found == sites_.end()) continue;
        for (const Eigen::Vector2d& other : found->second) {
          const Eigen::Vector2d apart =
              field_.periodic ? field_.wrapped(xy - other) : Eigen::Vector2d(xy - other);
          if (apart.norm() < distance_m_) return false;
        }
      }
    }
    return true;
  }
  void add(const Eigen::Vector2d& xy) { sites_[key(index(xy, 0), index(xy, 1))].push_back(xy); }

 private:
  long long index(const Eigen::Vector2d& xy, int k) const {
    return static_cast<long long>(std::floor((xy[k] + field_.size_m[k] / 2) / cell_[k]));
  }
  long long key(long long i, long long j) const {
    if (field_.periodic) {
      i = (i + count_[0]) % count_[0];
      j = (j + count_[1]) % count_[1];
    }
    return (j + 1) * (count_[0] + 2) + i + 1;
  }
  const PlantingField& field_;
  double distance_m_;
  long long count_[2];
  double cell_[2];
  std::unordered_map<long long, std::vector<Eigen::Vector2d>> sites_;
};

}  // namespace

std::vector<PlantingSite> plant_hard_core(const TomlValue& planting, PlantingField& field) {
  constexpr double jamming =
      0.547;  // coverage at which random sequential addition of discs ends (Feder 1980)
  constexpr int most_darts = 100000;
  const TomlValue density = planting.require("density_per_m2");
  const TomlValue distance_key = planting.require("min_distance_m");
  const double distance = distance_key.positive();
  const std::size_t count = plant_count(density.positive() * field.area_m2(), density);
  const double coverage = static_cast<double>(count) * pi * distance * distance / 4 / field.area_m2();
  const auto refuse = [&](std::size_t planted) {
    distance_key.reject(fmt::format(
        "{} plants this far apart do not fit at random ({} did); lower min_distance_m or the density", count,
        planted));
  };
  if (coverage > jamming) refuse(0);
  CellGrid grid(field, distance);
  std::vector<PlantingSite> out;
  while (out.size() < count) {
    int darts = 0;
    Eigen::Vector2d xy = field.anywhere();
    for (; !grid.is_free(xy) && darts < most_darts; ++darts) xy = field.anywhere();
    if (darts == most_darts) refuse(out.size());
    grid.add(xy);
    out.push_back({xy, 0, {}});
  }
  return out;
}

}  // namespace bpms
