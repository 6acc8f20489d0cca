// Where to put the rows of a strip or a tube: intervals are halved until none deviates more than the
// tolerance.
#pragma once
#include <algorithm>
#include <vector>

#include "plant/plant.h"

namespace bpms {

// First guess: the ends, the kinks of the organ's functions, and enough even steps that no wave is
// overlooked.
std::vector<double> first_nodes(const OrganAttributes& organ, double least_gap);

// Distance of a point from the line through two others (from the point they share when they coincide).
double distance_from_line(const Eigen::Vector3d& point, const Eigen::Vector3d& a, const Eigen::Vector3d& b);

// rows(nodes) gives the rows at these places; deviation(first, quarter points 1..3, last) of five of them the
// distance.
template <class Rows, class Deviation>
std::vector<double> subdivide(std::vector<double> nodes, const Rows& rows, const Deviation& deviation,
                              double tolerance, double least_gap) {
  constexpr int inner = 4;  // parts that an interval is looked at in
  constexpr std::size_t most_nodes = 20000;
  std::vector<bool> settled(nodes.size() - 1, false);
  while (nodes.size() < most_nodes) {
    std::vector<double> looked_at;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      if (settled[i]) continue;
      for (int k = 0; k <= inner; ++k) looked_at.push_back(nodes[i] + (nodes[i + 1] - nodes[i]) * k / inner);
    }
    const auto at = rows(looked_at);
    std::vector<double> next;
    std::vector<bool> next_settled;
    std::size_t used = 0;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      next.push_back(nodes[i]);
      bool split = false;
      if (!settled[i]) {
        split = nodes[i + 1] - nodes[i] > 2 * least_gap && deviation(&at[used]) > tolerance;
        used += inner + 1;
      }
      next_settled.push_back(!split);
      if (!split) continue;
      next.push_back((nodes[i] + nodes[i + 1]) / 2);
      next_settled.push_back(false);
    }
    next.push_back(nodes.back());
    nodes = std::move(next);
    settled = std::move(next_settled);
    if (std::ranges::all_of(settled, [](bool done) { return done; })) break;
  }
  return nodes;
}

}  // namespace bpms
