// Where to put the rows of a strip or a tube: intervals are halved until none deviates more than the
// tolerance. Each interval is looked at in its ends and quarter points, and what was computed there serves
// its halves: a row is made once.
#pragma once
#include <algorithm>
#include <array>
#include <vector>

#include "plant/plant.h"

namespace bpms {

// First guess: the ends, the kinks of the organ's functions, and enough even steps that no wave is
// overlooked.
std::vector<double> first_nodes(const OrganAttributes& organ, double least_gap);
// The nodes and the quarter points between them.
std::vector<double> with_quarters(const std::vector<double>& nodes);

// Sides of a polygon that stays within the tolerance of a circle (its sagitta).
int circle_sides(double radius_m, double tolerance_m, int least, int most);

// Distance of a point from the line through two others (from the point they share when they coincide).
double distance_from_line(const Eigen::Vector3d& point, const Eigen::Vector3d& a, const Eigen::Vector3d& b);

template <class Row>
using FiveRows = std::array<const Row*, 5>;  // the ends of an interval and its quarter points

// Halves intervals. between(a, b) makes the row in the middle of two, gap(a, b) says how far apart they are,
// deviation(FiveRows) how far the surface lies from what is drawn between the outer two.
template <class Row, class Between, class Gap, class Deviation>
class Subdivision {
 public:
  Subdivision(const Between& between, const Gap& gap, const Deviation& deviation, double tolerance,
              double least_gap)
      : between_(between), gap_(gap), deviation_(deviation), tolerance_(tolerance), least_gap_(least_gap) {}

  // `rows` at the first nodes and their quarter points; returns those that are needed.
  std::vector<Row> nodes(const std::vector<Row>& rows) {
    constexpr std::size_t inner = 4;
    out_.reserve(2 * rows.size());
    for (std::size_t i = 0; i + inner < rows.size(); i += inner) {
      out_.push_back(rows[i]);
      refine({&rows[i], &rows[i + 1], &rows[i + 2], &rows[i + 3], &rows[i + 4]});
    }
    out_.push_back(rows.back());
    return std::move(out_);
  }

 private:
  void refine(const FiveRows<Row>& r) {
    constexpr std::size_t most_nodes = 20000;
    if (out_.size() > most_nodes || !(gap_(*r[0], *r[4]) > 2 * least_gap_) || deviation_(r) <= tolerance_)
      return;
    const Row a = between_(*r[0], *r[1]), b = between_(*r[1], *r[2]);
    refine({r[0], &a, r[1], &b, r[2]});
    out_.push_back(*r[2]);
    const Row c = between_(*r[2], *r[3]), d = between_(*r[3], *r[4]);
    refine({r[2], &c, r[3], &d, r[4]});
  }

  const Between& between_;
  const Gap& gap_;
  const Deviation& deviation_;
  double tolerance_, least_gap_;
  std::vector<Row> out_;
};

template <class Row, class Between, class Gap, class Deviation>
std::vector<Row> subdivide(const std::vector<Row>& rows, const Between& between, const Gap& gap,
                           const Deviation& deviation, double tolerance, double least_gap) {
  return Subdivision<Row, Between, Gap, Deviation>(between, gap, deviation, tolerance, least_gap).nodes(rows);
}

}  // namespace bpms
