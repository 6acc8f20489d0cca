// The other noun of the plant floor: a canopy, that is plants and where each of them stands (canopy.toml),
// and the terrain below. Metres; the domain is centred at the origin; x east, y north; row azimuths clockwise
// from north, rotations counter-clockwise seen from above. Source: Lewis 1999 (BPMS paper) section 2.1.4;
// keys in docs/canopies.md.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plant/mesh.h"
#include "plant/plant.h"
#include "plant/terrain.h"

namespace bpms {

struct CanopyPlant {
  std::string file;
  std::shared_ptr<const Plant> plant;
  double probability = 1;                 // of all plants together: sums to 1
  std::shared_ptr<const Mesh> mesh = {};  // where planting needed it, else null
};

// One clone: the plant turned by `rotation` about z, scaled about its base, its z tilted the shortest way to
// `up`, moved to position_m.
struct Placement {
  std::uint32_t plant = 0;  // index into Canopy::plants
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  double rotation = 0;  // radians
  double scale = 1;
  Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
};

// What the plants stand on, where the canopy has terrain or ridges.
struct CanopyGround {
  std::shared_ptr<const Terrain> terrain;
  std::string material;
  std::optional<double> outside_height_m;  // of a level plane around an open canopy's terrain
};

// The share of the leaf area on triangles that cross triangles of other plants.
struct CanopyOverlap {
  double fraction = 0;
  double before = 0;      // as first planted; what it is now where nothing was asked to be reduced
  std::size_t moved = 0;  // plants that were turned or moved
};

struct Canopy {
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();
  bool periodic = true;
  std::uint64_t seed = 1;
  std::vector<CanopyPlant> plants;
  std::vector<Placement> placements;
  std::optional<CanopyGround> ground;
  std::optional<CanopyOverlap> overlap;  // where the file asks for it
  std::vector<std::string> inputs;       // files it was read from
  std::vector<std::string> notes;        // what was snapped, and by how much; notes of the plants
};

struct CanopyReadOptions {
  std::optional<std::uint64_t> seed;  // instead of the file's
  std::size_t most_plants = 10'000'000;
};

// Reads canopy.toml and its plants, and plants them. `seed` overrides the file's.
Canopy read_canopy(const std::string& path, std::optional<std::uint64_t> seed = {});
// The same for the file's text; other files are looked for beside `path`.
Canopy parse_canopy(const std::string& path, std::string_view text, const CanopyReadOptions& options = {});

}  // namespace bpms
