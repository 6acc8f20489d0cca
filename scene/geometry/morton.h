// Order along a space-filling (Morton) curve: neighbours in space become neighbours in memory.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace bpms {
// The permutation that sorts the points along the curve; equal points keep their order.
std::vector<std::uint32_t> morton_order(std::span<const Eigen::Vector3f> points);
}  // namespace bpms
