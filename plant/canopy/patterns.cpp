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

bool PlantingField::plant(const Eigen::Vector2d& xy, std::vector<PlantingSite>& out) const {
  if (!periodic && !holds(xy)) return false;
  out.push_back({periodic ? wrapped(xy) : xy});
  return true;
}

Eigen::Vector2d PlantingField::anywhere(Philox& from) const {
  const double x = from.uniform(-0.5, 0.5);
  return {x * size_m.x(), from.uniform(-0.5, 0.5) * size_m.y()};
}

std::size_t PlantingField::plant_count(double plants, const TomlValue& where) const {
  const double count = std::round(plants);
  if (!(count >= 1))
    where.reject(fmt::format("gives {:.3g} plants in the domain, expected at least one", plants));
  if (count > static_cast<double>(most_plants))
    where.reject(fmt::format("gives {:.3g} plants in the domain, more than {}", plants, most_plants));
  return static_cast<std::size_t>(count);
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

}  // namespace bpms
