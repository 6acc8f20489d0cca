// Counter-based random numbers: a value depends on what is sampled (seed, stream, sample, dimension) and on
// nothing else, so results are the same bit for bit on any number of threads. Philox4x32-10: Salmon et al.
// 2011. Sobol points with Owen scrambling: Owen 1995; hash-based nested uniform scrambling after Laine &
// Karras 2011 with Vegdahl's and Burley's (JCGT 2020) hash; direction numbers of Joe & Kuo 2008.
#pragma once
#include <array>
#include <cstdint>

namespace bpms {

// Four independent 32-bit words for a key and a counter.
std::array<std::uint32_t, 4> philox(std::uint64_t key, std::uint64_t counter_high, std::uint64_t counter_low);

// A double in [0, 1), never 1, from 32 bits (2^-32 steps, offset by half a step: never 0 either).
constexpr double unit_interval(std::uint32_t bits) {
  return (static_cast<double>(bits) + 0.5) * 0x1p-32;
}

// A sequential stream, for code that just needs numbers (planting, tests): keyed by seed and stream.
class Philox {
 public:
  explicit Philox(std::uint64_t seed, std::uint64_t stream = 0) : seed_(seed), stream_(stream) {}
  std::uint32_t bits();
  double uniform();  // (0, 1)
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  double normal();                           // mean 0, sd 1 (Box-Muller)
  std::uint64_t below(std::uint64_t count);  // 0 .. count-1, count <= 2^32

 private:
  std::uint64_t seed_;
  std::uint64_t stream_;
  std::uint64_t counter_ = 0;
  std::array<std::uint32_t, 4> block_{};
  int used_ = 4;
};

inline constexpr int sobol_dimensions = 8;
// Sobol point `index`, dimension `dimension` (< sobol_dimensions), as 32 bits, unscrambled.
std::uint32_t sobol(std::uint32_t index, int dimension);
// Owen-scrambled: `seed` picks the scramble (give each dimension and each batch its own).
std::uint32_t owen_scramble(std::uint32_t bits, std::uint32_t seed);
// One coordinate of a randomised point: the index is shuffled and the value scrambled, keyed by (seed,
// stream, dimension); dimensions come in groups of 4 that are padded independently, so any number of
// dimensions may be asked.
double sobol_owen(std::uint32_t index, int dimension, std::uint64_t seed);

}  // namespace bpms
