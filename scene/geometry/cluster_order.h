// An order in which every `size` points that follow each other lie close together: halves at the median
// across the widest extent, and halves of halves.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace bpms {
// The permutation; all clusters but the last are full.
std::vector<std::uint32_t> cluster_order(std::span<const Eigen::Vector3f> points, std::size_t size);
}  // namespace bpms
