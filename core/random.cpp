#include "core/random.h"

#include <Random123/philox.h>

#include <cmath>
#include <numbers>

namespace bpms {

std::array<std::uint32_t, 4> philox(std::uint64_t key, std::uint64_t counter_high,
                                    std::uint64_t counter_low) {
  const r123::Philox4x32 generator;
  r123::Philox4x32::ctr_type counter{
      {static_cast<std::uint32_t>(counter_low), static_cast<std::uint32_t>(counter_low >> 32),
       static_cast<std::uint32_t>(counter_high), static_cast<std::uint32_t>(counter_high >> 32)}};
  r123::Philox4x32::key_type words{{static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)}};
  const auto out = generator(counter, words);
  return {out[0], out[1], out[2], out[3]};
}

std::uint32_t Philox::bits() {
  if (used_ == 4) {
    block_ = philox(seed_, stream_, counter_++);
    used_ = 0;
  }
  return block_[static_cast<std::size_t>(used_++)];
}

double Philox::uniform() {
  return unit_interval(bits());
}

double Philox::normal() {
  const double radius = std::sqrt(-2.0 * std::log(uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

std::uint64_t Philox::below(std::uint64_t count) {
  return static_cast<std::uint64_t>(uniform() * static_cast<double>(count));
}

namespace {

// Primitive polynomials and initial direction numbers, new-joe-kuo-6.21201 (Joe & Kuo 2008), dimensions 2
// to 8.
struct Direction {
  int degree;
  std::uint32_t polynomial;
  std::array<std::uint32_t, 5> initial;
};
constexpr std::array<Direction, 7> joe_kuo{{
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
}};

using Matrix = std::array<std::uint32_t, 32>;  // column k = direction number of index bit k

constexpr std::array<Matrix, sobol_dimensions> make_matrices() {
  std::array<Matrix, sobol_dimensions> out{};
  for (int k = 0; k < 32; ++k) out[0][static_cast<std::size_t>(k)] = 1u << (31 - k);
  for (std::size_t d = 1; d < sobol_dimensions; ++d) {
    const Direction& from = joe_kuo[d - 1];
    const auto s = static_cast<std::size_t>(from.degree);
    Matrix& v = out[d];
    for (std::size_t k = 0; k < s; ++k) v[k] = from.initial[k] << (31 - k);
    for (std::size_t k = s; k < 32; ++k) {
      v[k] = v[k - s] ^ (v[k - s] >> s);
      for (std::size_t i = 1; i < s; ++i) v[k] ^= ((from.polynomial >> (s - 1 - i)) & 1u) * v[k - i];
    }
  }
  return out;
}
// The columns' sums for each value of each four bits of the index: eight looks instead of thirty-two.
using Sums = std::array<std::array<std::uint32_t, 16>, 8>;
constexpr std::array<Sums, sobol_dimensions> make_sums() {
  std::array<Sums, sobol_dimensions> out{};
  const auto matrices = make_matrices();
  for (std::size_t d = 0; d < sobol_dimensions; ++d)
    for (std::size_t group = 0; group < 8; ++group)
      for (std::size_t value = 0; value < 16; ++value)
        for (std::size_t bit = 0; bit < 4; ++bit)
          if ((value >> bit & 1u) != 0) out[d][group][value] ^= matrices[d][4 * group + bit];
  return out;
}
constexpr auto sums = make_sums();

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = (x >> 16) | (x << 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

constexpr std::uint64_t mix(std::uint64_t x) {  // splitmix64's finaliser
  x ^= x >> 30;
  x *= 0xbf58476d1ce4e5b9ull;
  x ^= x >> 27;
  x *= 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

}  // namespace

std::uint32_t sobol(std::uint32_t index, int dimension) {
  const Sums& of = sums[static_cast<std::size_t>(dimension)];
  std::uint32_t out = 0;
  for (std::size_t group = 0; group < 8; ++group) out ^= of[group][index >> (4 * group) & 15u];
  return out;
}

std::uint32_t owen_scramble(std::uint32_t bits, std::uint32_t seed) {
  std::uint32_t x = reverse_bits(bits);
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return reverse_bits(x);
}

double sobol_owen(std::uint32_t index, int dimension, std::uint64_t seed) {
  const auto group = static_cast<std::uint64_t>(dimension / 4);
  const std::uint64_t group_key = mix(seed ^ mix(group + 0x9e3779b97f4a7c15ull));
  const std::uint32_t shuffled = owen_scramble(index, static_cast<std::uint32_t>(group_key));
  const std::uint64_t key = mix(group_key + static_cast<std::uint64_t>(dimension % 4) + 1);
  return unit_interval(owen_scramble(sobol(shuffled, dimension % 4), static_cast<std::uint32_t>(key)));
}

}  // namespace bpms
