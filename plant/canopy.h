// The other noun of the plant floor: a canopy, that is plants and where each of their clones stands
// (canopy.toml). Metres; the domain is centred at the origin; x east, y north; row azimuths clockwise from
// north, rotations counter-clockwise seen from above. Source: Lewis 1999 (BPMS paper) section 2.1.4; keys in
// docs/canopies.md.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plant/plant.h"

namespace bpms {

struct CanopyPlant {
  std::string file;
  std::shared_ptr<const Plant> plant;
  double probability = 1;  // of all plants together: sums to 1
};

// One clone: the plant turned by `rotation` about z, scaled about its base, moved to position_m.
struct Placement {
  std::uint32_t plant = 0;  // index into Canopy::plants
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  double rotation = 0;  // radians
  double scale = 1;
};

struct Canopy {
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();
  bool periodic = true;
  std::uint64_t seed = 1;
  std::vector<CanopyPlant> plants;
  std::vector<Placement> placements;
  std::vector<std::string> inputs;  // files it was read from
  std::vector<std::string> notes;   // what was snapped, and by how much; notes of the plants
};

// Reads canopy.toml and its plants, and plants them. `seed` overrides the file's.
Canopy read_canopy(const std::string& path, std::optional<std::uint64_t> seed = {});

}  // namespace bpms
