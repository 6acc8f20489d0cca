#include "plant/plant_solids.h"

#include <Eigen/Geometry>
#include <cmath>

#include "plant/geometry/swept_body.h"
#include "plant/leaf_frame.h"

namespace bpms {
namespace {

// A link of the chain, before it is made to reach into its neighbours.
struct Link {
  Eigen::Vector3d from, to, along;  // along: unit
  double length, first_radius, second_radius;
  double slope() const { return (second_radius - first_radius) / length; }
};

std::vector<Link> chain_links(const std::vector<Ring>& rings, double point_below_m) {
  // What is straight and of one slope is one link.
  constexpr double same_direction = 1e-12, same_slope = 1e-9;
  std::vector<Link> out;
  const auto radius = [&](const Ring& r) { return r.radius_m <= point_below_m ? 0 : r.radius_m; };
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    Link link{rings[i].centre_m, rings[i + 1].centre_m, {}, 0, radius(rings[i]), radius(rings[i + 1])};
    link.along = link.to - link.from;
    link.length = link.along.norm();
    if (!(link.length > 0) || (link.first_radius == 0 && link.second_radius == 0)) continue;
    link.along /= link.length;
    if (!out.empty() && out.back().to == link.from) {
      Link& last = out.back();
      if (last.along.dot(link.along) > 1 - same_direction &&
          std::abs(last.slope() - link.slope()) < same_slope) {
        last.to = link.to, last.second_radius = link.second_radius;
        last.length += link.length;
        continue;
      }
    }
    out.push_back(link);
  }
  return out;
}

// How far two links must reach past their common end for the outer side of the bend to close: to where their
// walls meet.
double overlap_m(const Link& a, const Link& b) {
  if (a.to != b.from) return 0;
  const double half_angle = std::atan2(a.along.cross(b.along).norm(), a.along.dot(b.along)) / 2;
  constexpr double most = 0.5;
  return std::min(a.second_radius * std::tan(half_angle), most * std::min(a.length, b.length));
}

}  // namespace

std::vector<PlantSolid> plant_solids(const Plant& plant, double tolerance_m) {
  std::vector<PlantSolid> out;
  for (const PlacedOrgan& organ : place_organs(plant)) {
    if (organ.kind == OrganKind::leaf) continue;
    const auto add = [&](PlantSolid::Kind kind, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                         double first_radius, double second_radius) {
      out.push_back({kind, organ.plant_from_organ * from, organ.plant_from_organ * to, first_radius,
                     second_radius, organ.id});
    };
    const double ball = joint_radius_m(*organ.attributes);
    if (ball > 0) {
      const MidribPoint tip = midrib(*organ.attributes, {1.0}).back();
      const Eigen::Vector3d up = ball * tip.frame.col(2);
      add(PlantSolid::Kind::spheroid, tip.x_m - up, tip.x_m + up, ball, ball);
    }
    const SweptBody body = swept_body(organ.kind, *organ.attributes);
    if (body.empty()) continue;
    if (body.rounded && body.is_straight()) {
      const double radius = organ.attributes->radius_m;
      add(PlantSolid::Kind::spheroid, {0, 0, 0}, {0, 0, body.length_m}, radius, radius);
      continue;
    }
    const std::vector<Link> links = chain_links(ring_nodes(body, tolerance_m / 2), body.point_below_m());
    for (std::size_t k = 0; k < links.size(); ++k) {
      const Link& link = links[k];
      const double before = k > 0 ? overlap_m(links[k - 1], link) : 0;
      const double behind = k + 1 < links.size() ? overlap_m(link, links[k + 1]) : 0;
      add(PlantSolid::Kind::frustum, link.from - before * link.along, link.to + behind * link.along,
          std::max(0.0, link.first_radius - before * link.slope()),
          std::max(0.0, link.second_radius + behind * link.slope()));
    }
  }
  return out;
}

}  // namespace bpms
