// Random plants no nearer to each other than min_distance_m: random sequential addition (darts), with the
// distance taken around the border in a periodic domain.
#include <cmath>
#include <limits>

#include "core/units.h"
#include "plant/canopy/pattern.h"

namespace bpms {
namespace {

constexpr std::uint32_t no_site = std::numeric_limits<std::uint32_t>::max();

// Sites by cell, chained; cells are at least the distance wide, so that a conflict lies in the neighbouring
// ones, and there are no more of them than sites expected.
class SiteGrid {
 public:
  SiteGrid(const PlantingField& field, double distance_m, std::size_t expected)
      : size_m_(field.size_m), periodic_(field.periodic), distance_m_(distance_m) {
    const double wide = std::max(distance_m, std::sqrt(field.area_m2() / static_cast<double>(expected)));
    for (int k = 0; k < 2; ++k) {
      count_[k] = std::max<long long>(1, static_cast<long long>(field.size_m[k] / wide));
      cell_[k] = field.size_m[k] / static_cast<double>(count_[k]);
    }
    first_.assign(static_cast<std::size_t>(count_[0] * count_[1]), no_site);
    sites_.reserve(expected);
    next_.reserve(expected);
  }
  // `but`: a site that does not count.
  bool is_free(const Eigen::Vector2d& xy, std::uint32_t but = no_site) const {
    const long long x = index(xy, 0), y = index(xy, 1);
    for (long long dy = -1; dy <= 1; ++dy) {
      for (long long dx = -1; dx <= 1; ++dx) {
        const long long cell = cell_number(x + dx, y + dy);
        if (cell >= 0 && conflicts(first_[static_cast<std::size_t>(cell)], xy, but)) return false;
      }
    }
    return true;
  }
  void add(const Eigen::Vector2d& xy) {
    sites_.push_back(xy);
    next_.push_back(no_site);
    chain(static_cast<std::uint32_t>(sites_.size() - 1));
  }
  void move(std::uint32_t site, const Eigen::Vector2d& to) {
    std::uint32_t* at = &first_[own_cell(sites_[site])];
    while (*at != site) at = &next_[*at];
    *at = next_[site];
    sites_[site] = to;
    chain(site);
  }
  const std::vector<Eigen::Vector2d>& sites() const { return sites_; }

 private:
  bool conflicts(std::uint32_t site, const Eigen::Vector2d& xy, std::uint32_t but) const {
    for (; site != no_site; site = next_[site]) {
      if (site == but) continue;
      Eigen::Vector2d apart = xy - sites_[site];
      if (periodic_)
        for (int k = 0; k < 2; ++k) apart[k] -= size_m_[k] * std::round(apart[k] / size_m_[k]);
      if (apart.squaredNorm() < distance_m_ * distance_m_) return true;
    }
    return false;
  }
  void chain(std::uint32_t site) {
    std::uint32_t& first = first_[own_cell(sites_[site])];
    next_[site] = first;
    first = site;
  }
  long long index(const Eigen::Vector2d& xy, int k) const {
    return std::clamp(static_cast<long long>(std::floor((xy[k] + size_m_[k] / 2) / cell_[k])), 0LL,
                      count_[k] - 1);
  }
  std::size_t own_cell(const Eigen::Vector2d& xy) const {
    return static_cast<std::size_t>(cell_number(index(xy, 0), index(xy, 1)));
  }
  long long cell_number(long long i, long long j) const {  // -1: beside an open field
    if (periodic_) {
      i = (i + count_[0]) % count_[0];
      j = (j + count_[1]) % count_[1];
    }
    return i < 0 || j < 0 || i >= count_[0] || j >= count_[1] ? -1 : j * count_[0] + i;
  }
  Eigen::Vector2d size_m_;
  bool periodic_;
  double distance_m_;
  long long count_[2];
  double cell_[2];
  std::vector<std::uint32_t> first_, next_;
  std::vector<Eigen::Vector2d> sites_;
};

class HardCoreFreedom : public SiteFreedom {
 public:
  HardCoreFreedom(SiteGrid grid, const PlantingField& field)
      : grid_(std::move(grid)), field_{field.size_m, field.periodic, Philox(0)} {}
  std::optional<Eigen::Vector2d> again(std::size_t i, Philox& random) override {
    constexpr int darts = 1000;
    for (int k = 0; k < darts; ++k) {
      const Eigen::Vector2d xy = field_.anywhere(random);
      if (grid_.is_free(xy, static_cast<std::uint32_t>(i))) return xy;
    }
    return std::nullopt;
  }
  void move(std::size_t i, const Eigen::Vector2d& to) override {
    grid_.move(static_cast<std::uint32_t>(i), to);
  }

 private:
  SiteGrid grid_;
  PlantingField field_;
};

}  // namespace

std::vector<PlantingSite> plant_hard_core(const TomlValue& planting, PlantingField& field) {
  constexpr double jamming =
      0.547;  // coverage at which random sequential addition of discs ends (Feder 1980)
  constexpr double darts_a_plant = 300, darts_at_least = 100'000;
  const TomlValue density = planting.require("density_per_m2");
  const TomlValue distance_key = planting.require("min_distance_m");
  const double distance = distance_key.positive();
  const std::size_t count = field.plant_count(density.positive() * field.area_m2(), density);
  const double disc_m2 = pi * distance * distance / 4;
  if (static_cast<double>(count) * disc_m2 > jamming * field.area_m2())
    distance_key.reject(
        fmt::format("{} plants this far apart do not fit at random: {:.6g} per m2 are asked for, some {:.4g} "
                    "is the most; lower min_distance_m or the density",
                    count, static_cast<double>(count) / field.area_m2(), jamming / disc_m2));
  SiteGrid grid(field, distance, count);
  double darts = darts_at_least + darts_a_plant * static_cast<double>(count);
  while (grid.sites().size() < count) {
    const Eigen::Vector2d xy = field.anywhere();
    if (grid.is_free(xy)) grid.add(xy);
    if (--darts < 0)
      distance_key.reject(fmt::format(
          "{} plants this far apart do not fit at random: {} did, {:.6g} per m2; lower "
          "min_distance_m or the density",
          count, grid.sites().size(), static_cast<double>(grid.sites().size()) / field.area_m2()));
  }
  std::vector<PlantingSite> out;
  out.reserve(count);
  for (const Eigen::Vector2d& xy : grid.sites()) out.push_back({xy});
  if (field.want_freedom) field.freedom = std::make_unique<HardCoreFreedom>(std::move(grid), field);
  return out;
}

}  // namespace bpms
