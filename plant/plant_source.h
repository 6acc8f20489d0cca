// Where the plants of a stand come from: clones of a few plants, a set of which each stands once, and
// whatever else can make a plant for each place. To add one: a file in plant/canopy/ and a word in
// read_plant_source.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/random.h"
#include "core/toml.h"
#include "plant/canopy.h"

namespace bpms {

struct PlantDraw {
  std::uint32_t plant = 0;  // index into the plants of stand()
  double rotation = 0;      // radians
  double scale = 1;
};

// A stand's plants as they are read, with what is to be told of them.
struct PlantSet {
  std::vector<CanopyPlant> plants;
  std::vector<std::string> inputs;
  std::vector<std::string> notes;
};

class PlantSource {
 public:
  virtual ~PlantSource() = default;
  // The different plants of a stand of `count`; called once, before any is drawn. bad_input where the source
  // cannot supply so many.
  virtual PlantSet stand(std::size_t count, std::uint64_t seed) = 0;
  // The plant that stands as number k. `random` is that plant's own stream. Re-entrant.
  virtual PlantDraw draw(std::size_t k, Philox& random) const = 0;
  // Another rotation for a plant, as draw() would give it.
  virtual double rotation(std::uint32_t plant, Philox& random) const = 0;
};

// Of [[plants]] and the keys mode and order of [planting]; null where there are no [[plants]].
std::unique_ptr<PlantSource> read_plant_source(const TomlValue& root);

}  // namespace bpms
