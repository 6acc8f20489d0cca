// Rows of the structure report: each organ of each prototype, each species (prototype), each plant as it
// stands.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace bpms {

struct OrganRow {
  std::string prototype, label, kind, material;
  int id = 0;
  double length_m = 0, area_m2 = 0;       // one-sided for leaves; of the prototype, unscaled
  std::optional<double> inclination_deg;  // of leaves: area-weighted mean
  double low_m = 0, high_m = 0;           // in the prototype's frame
  Mesh::Organ::Named properties;
};

struct SpeciesRow {
  std::string prototype;
  std::size_t count = 0;                       // instances
  double leaf_area_m2 = 0, other_area_m2 = 0;  // of all of them
  std::optional<double> inclination_deg;       // of leaves
  double height_m = 0;                         // of the highest above its base
};

struct PlantRow {
  std::uint32_t plant = 0;
  std::string prototype;  // of its first part
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  double leaf_area_m2 = 0, other_area_m2 = 0;
  double height_m = 0;  // of its highest point above its first part's base
};

struct StructureTables {
  std::vector<OrganRow> organs;
  std::vector<SpeciesRow> species;
  std::vector<PlantRow> plants;
};
StructureTables structure_tables(const Scene& scene);

}  // namespace bpms
