// The random numbers of a path: Owen-scrambled Sobol points for the start and the first two interactions (8
// dimensions), Philox beyond. Every number depends on (seed, sensor, view, batch, sample, dimension) alone.
// Batches of one view have independent scrambles.
#pragma once
#include <array>
#include <cstdint>

#include "core/random.h"

namespace bpms {

struct ViewKey {
  std::uint64_t seed = 1;
  std::uint32_t sensor = 0;
  std::uint64_t view = 0;
};

// The numbers that one interaction uses.
struct InteractionNumbers {
  double side, direction_u, direction_v, survival;
};

class PathNumbers {
 public:
  PathNumbers(const ViewKey& key, std::uint32_t batch)
      : key_(word(key.seed, key.sensor, key.view)), scramble_(word(key_, 0x5eedu, batch)), batch_(batch) {}
  void start(std::uint64_t sample) { sample_ = sample; }

  std::array<double, 2> position() const { return {sobol_of(0), sobol_of(1)}; }
  InteractionNumbers interaction(std::uint32_t number) const {
    const auto bits = philox(key_, (std::uint64_t{batch_} << 40) ^ sample_, number);
    InteractionNumbers out{unit_interval(bits[0]), unit_interval(bits[1]), unit_interval(bits[2]),
                           unit_interval(bits[3])};
    if (number < 2) {
      const int first = number == 0 ? 2 : 5;
      out.direction_u = sobol_of(first);
      out.direction_v = sobol_of(first + 1);
      out.side = sobol_of(first + 2);
    }
    return out;
  }

 private:
  static std::uint64_t word(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    const auto out = philox(a, b, c);
    return (std::uint64_t{out[1]} << 32) | out[0];
  }
  double sobol_of(int dimension) const {
    return sobol_owen(static_cast<std::uint32_t>(sample_), dimension, scramble_);
  }
  std::uint64_t key_;
  std::uint64_t scramble_;
  std::uint32_t batch_;
  std::uint64_t sample_ = 0;
};

}  // namespace bpms
