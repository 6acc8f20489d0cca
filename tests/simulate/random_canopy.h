// Discs with uniform positions in a periodic box and uniform (spherical) normals, as a disc list.
#pragma once
#include <cstdint>
#include <string>

namespace bpms::test {
struct RandomCanopy {
  double side_m = 4, height_m = 2, radius_m = 0.05, lai = 1;
  std::uint64_t seed = 1;
};
std::string disc_list(const RandomCanopy& canopy);
}  // namespace bpms::test
