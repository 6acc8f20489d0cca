// The random numbers of a path: Owen-scrambled Sobol points for the start and the first interaction, Philox
// beyond (on the homogeneous disc canopy Sobol points there take time and leave the variance as it is). Every
// number depends on (seed, sensor, view, batch, sample, branch, dimension) alone. Batches of one view have
// independent scrambles, and so have the branches of a path that was split.
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
  // sample < 2^32, branch < 256.
  void start(std::uint64_t sample, std::uint32_t branch = 0) {
    sample_ = sample;
    branch_ = branch;
  }

  std::array<double, 2> position() const { return {sobol_of(0), sobol_of(1)}; }
  std::array<double, 2> aperture() const { return {sobol_of(8), sobol_of(9)}; }
  double wavelength(std::uint32_t band) const { return unit_interval(words(band, 1)[0]); }
  InteractionNumbers interaction(std::uint32_t number) const {
    const auto bits = words(number, 0);
    InteractionNumbers out{unit_interval(bits[0]), unit_interval(bits[1]), unit_interval(bits[2]),
                           unit_interval(bits[3])};
    if (number == 0) {
      const int first = 2 + static_cast<int>(branch_) * per_branch;
      out.direction_u = sobol_of(first);
      out.direction_v = sobol_of(first + 1);
      out.side = sobol_of(first + 2);
    }
    return out;
  }
  // Where on a disc of a sun (source = its number) or in the sky (source = the number of suns) an interaction
  // asks for light.
  std::array<double, 2> light(std::uint32_t interaction, std::uint32_t source) const {
    const auto bits = words(interaction, 2 + source);
    return {unit_interval(bits[0]), unit_interval(bits[1])};
  }

 private:
  static constexpr int per_branch = 12;
  static std::uint64_t word(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    const auto out = philox(a, b, c);
    return (std::uint64_t{out[1]} << 32) | out[0];
  }
  std::array<std::uint32_t, 4> words(std::uint32_t number, std::uint32_t purpose) const {
    return philox(key_, (std::uint64_t{batch_} << 40) ^ (std::uint64_t{branch_} << 32) ^ sample_,
                  (std::uint64_t{purpose} << 32) | number);
  }
  double sobol_of(int dimension) const {
    return sobol_owen(static_cast<std::uint32_t>(sample_), dimension, scramble_);
  }
  std::uint64_t key_;
  std::uint64_t scramble_;
  std::uint32_t batch_;
  std::uint32_t branch_ = 0;
  std::uint64_t sample_ = 0;
};

}  // namespace bpms
