// Planting patterns: where plants stand in the domain. To add one: one file NAME.cpp with a function, one
// line in the table of patterns.cpp.
#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/random.h"
#include "core/toml.h"
#include "plant/canopy/row_lines.h"

namespace bpms {

struct PlantingSite {
  Eigen::Vector2d xy_m;
  double z_m = 0;
  std::optional<double> rotation = {}, scale = {};  // given by the file for this plant
  std::optional<std::uint32_t> plant = {};          // index into PlantingField::named_plants
};

// Where else a plant of a pattern might as well stand.
class SiteFreedom {
 public:
  virtual ~SiteFreedom() = default;
  // Another place for site i, or nothing where the pattern leaves it none.
  virtual std::optional<Eigen::Vector2d> again(std::size_t i, Philox& random) = 0;
  // Site i stands there from now on.
  virtual void move(std::size_t, const Eigen::Vector2d&) {}
};

struct NamedPlant {
  std::string file;
  SourceLocation where;  // where it was named
};

struct PlantingField {
  Eigen::Vector2d size_m;
  bool periodic;
  Philox random;
  bool snap_domain = false;  // rows keep what they are and the periodic domain changes
  std::size_t most_plants = 10'000'000;
  bool want_freedom = false;

  // What the pattern tells.
  std::vector<std::string> notes = {};
  std::vector<std::string> inputs = {};       // files that it read
  double wanted = 0;                          // plants that its density asks for; 0: it asks for none
  std::optional<RowLines> rows = {};          // of a pattern of rows
  std::vector<NamedPlant> named_plants = {};  // that a stem map asks for
  std::unique_ptr<SiteFreedom> freedom = {};  // null where it leaves none or none was wanted

  double area_m2() const { return size_m.x() * size_m.y(); }
  // Into the domain [-size/2, size/2) of a periodic field.
  Eigen::Vector2d wrapped(const Eigen::Vector2d& xy) const;
  bool holds(const Eigen::Vector2d& xy) const;
  Eigen::Vector2d anywhere() { return anywhere(random); }
  Eigen::Vector2d anywhere(Philox& from) const;
  // A plant at xy: wrapped where the field is periodic, left out (false) where it falls beside an open one.
  bool plant(const Eigen::Vector2d& xy, std::vector<PlantingSite>& out) const;
  // Plants in the whole field, rounded; bad_input for none or too many.
  std::size_t plant_count(double plants, const TomlValue& where) const;
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

}  // namespace bpms
