// Planting patterns: where plants stand in the domain. To add one: one file NAME.cpp with a function, one
// line in the table of patterns.cpp.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/random.h"
#include "core/toml.h"

namespace bpms {

struct PlantingSite {
  Eigen::Vector2d xy_m;
  double z_m = 0;
  std::optional<double> rotation;  // given by the file for this plant
};

struct PlantingField {
  Eigen::Vector2d size_m;
  bool periodic;
  Philox random;
  std::vector<std::string> notes;
  std::vector<std::string> inputs;  // files that the pattern read
  double wanted = 0;                // plants that its density asks for; 0: it asks for none

  double area_m2() const { return size_m.x() * size_m.y(); }
  // Into the domain [-size/2, size/2) of a periodic field.
  Eigen::Vector2d wrapped(const Eigen::Vector2d& xy) const;
  bool holds(const Eigen::Vector2d& xy) const;
  Eigen::Vector2d anywhere();
  // A plant at xy: wrapped where the field is periodic, left out where it falls beside an open one.
  void plant(const Eigen::Vector2d& xy, std::vector<PlantingSite>& out) const;
};

using Pattern = std::vector<PlantingSite> (*)(const TomlValue& planting, PlantingField& field);
Pattern find_pattern(const TomlValue& name);

// A number, or { mean, sd }.
struct MeanSd {
  double mean = 0;
  double sd = 0;
};
MeanSd mean_sd(const TomlValue& value);
MeanSd positive_mean_sd(const TomlValue& value);
// Plants in the whole field for a density; bad_input for none or more than ten million.
std::size_t plant_count(double plants, const TomlValue& where);

}  // namespace bpms
