// The eight-node Gauss-Legendre rule on [-1, 1] (Abramowitz & Stegun 25.4.30), nodes rising.
#pragma once
#include <array>

namespace bpms {

struct GaussNode {
  double x;
  double weight;
};
inline constexpr std::array<GaussNode, 8> gauss_legendre_8{{
    {-0.9602898564975363, 0.1012285362903763},
    {-0.7966664774136267, 0.2223810344533745},
    {-0.5255324099163290, 0.3137066458778873},
    {-0.1834346424956498, 0.3626837833783620},
    {0.1834346424956498, 0.3626837833783620},
    {0.5255324099163290, 0.3137066458778873},
    {0.7966664774136267, 0.2223810344533745},
    {0.9602898564975363, 0.1012285362903763},
}};

}  // namespace bpms
