#include <cmath>

#include "plant/canopy/pattern.h"

namespace bpms {

std::vector<PlantingSite> plant_rows(const TomlValue&, PlantingField&),
    plant_regular(const TomlValue&, PlantingField&), plant_random(const TomlValue&, PlantingField&),
    plant_hard_core(const TomlValue&, PlantingField&), plant_list(const TomlValue&, PlantingField&);

namespace {
struct NamedPattern {
  const char* name;
  Pattern pattern;
};
constexpr NamedPattern patterns[] = {
    {"rows", plant_rows},           {"regular", plant_regular}, {"random", plant_random},
    {"hard_core", plant_hard_core}, {"list", plant_list},
};
}  // namespace

Pattern find_pattern(const TomlValue& name) {
  std::vector<std::string> known;
  for (const NamedPattern& entry : patterns) known.emplace_back(entry.name);
  const std::string wanted = name.one_of(known);
  for (const NamedPattern& entry : patterns) {
    if (wanted == entry.name) return entry.pattern;
  }
  name.reject("unknown pattern");
}

Eigen::Vector2d PlantingField::wrapped(const Eigen::Vector2d& xy) const {
  Eigen::Vector2d out;
  for (int k = 0; k < 2; ++k) {
    out[k] = xy[k] - size_m[k] * std::floor(xy[k] / size_m[k] + 0.5);
    if (out[k] >= size_m[k] / 2) out[k] = -size_m[k] / 2;  // by rounding
  }
  return out;
}

bool PlantingField::holds(const Eigen::Vector2d& xy) const {
  return (xy.cwiseAbs().array() <= size_m.array() / 2).all();
}

void PlantingField::plant(const Eigen::Vector2d& xy, std::vector<PlantingSite>& out) const {
  if (periodic)
    out.push_back({wrapped(xy), 0, {}});
  else if (holds(xy))
    out.push_back({xy, 0, {}});
}

Eigen::Vector2d PlantingField::anywhere() {
  const double x = random.uniform(-0.5, 0.5);
  return {x * size_m.x(), random.uniform(-0.5, 0.5) * size_m.y()};
}

MeanSd mean_sd(const TomlValue& value) {
  if (!value.is_table()) return {value.number(), 0};
  const double sd = value.number_or("sd", 0);
  if (sd < 0) value.get("sd").reject(fmt::format("found {}, expected a standard deviation of 0 or more", sd));
  return {value.require("mean").number(), sd};
}

MeanSd positive_mean_sd(const TomlValue& value) {
  const MeanSd out = mean_sd(value);
  if (out.mean <= 0) value.reject(fmt::format("found {}, expected a mean above 0", out.mean));
  return out;
}

std::size_t plant_count(double plants, const TomlValue& where) {
  constexpr double most = 1e7;
  const double count = std::round(plants);
  if (count < 1)
    where.reject(fmt::format("gives {:.3g} plants in the domain, expected at least one", plants));
  if (count > most)
    where.reject(fmt::format("gives {:.3g} plants in the domain, more than {:.0f}", plants, most));
  return static_cast<std::size_t>(count);
}

}  // namespace bpms
