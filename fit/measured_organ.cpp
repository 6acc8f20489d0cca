#include "fit/measured_organ.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "core/error.h"
#include "core/nearest.h"

namespace bpms {
namespace {

bool fitted_organ(const std::string& organ) {
  return organ == "leaf" || organ == "stem" || organ == "head";
}

std::vector<VectorPoint>* points_of(MeasuredOrgan& organ, const std::string& feature) {
  if (feature == "midrib" || feature == "axis") return &organ.midrib;
  if (feature == "edge_left") return &organ.edge_left;
  if (feature == "edge_right") return &organ.edge_right;
  return nullptr;
}

}  // namespace

std::vector<MeasuredOrgan> group_organs(const std::vector<VectorPoint>& points,
                                        std::vector<std::string>& notes) {
  std::vector<MeasuredOrgan> out;
  std::map<std::tuple<std::string, std::string, int, std::string>, std::size_t> known;
  std::map<std::string, int> ignored;
  for (const VectorPoint& point : points) {
    const OrganLabel& label = point.label;
    if (label.organ == "bud") continue;  // a place, see bud_of_plant
    if (!fitted_organ(label.organ)) {
      ++ignored["organ '" + label.organ + "'"];
      continue;
    }
    const auto [at, added] =
        known.try_emplace({label.plant, label.axis, label.rank, label.organ}, out.size());
    if (added) {
      MeasuredOrgan organ;
      organ.plant = label.plant;
      organ.axis = label.axis;
      organ.rank = label.rank;
      organ.organ = label.organ;
      organ.key =
          fmt::format("plant {} axis {} rank {} {}", label.plant, label.axis, label.rank, label.organ);
      out.push_back(std::move(organ));
    }
    if (std::vector<VectorPoint>* list = points_of(out[at->second], label.feature)) {
      list->push_back(point);
    } else {
      const std::vector<std::string> fitted{"midrib", "axis", "edge_left", "edge_right"};
      if (const std::string meant = nearest_word(label.feature, fitted); !meant.empty())
        bad_input(point.where, "unknown feature {}; did you mean {}?", in_quotes(label.feature),
                  in_quotes(meant));
      ++ignored["feature '" + label.feature + "' of " + label.organ];
    }
  }
  for (MeasuredOrgan& organ : out) {
    for (auto* list : {&organ.midrib, &organ.edge_left, &organ.edge_right})
      std::stable_sort(list->begin(), list->end(),
                       [](const auto& a, const auto& b) { return a.point < b.point; });
  }
  for (const auto& [what, count] : ignored)
    notes.push_back(fmt::format("{}: {} points left out: no function is fitted to them", what, count));
  return out;
}

std::optional<Eigen::Vector3d> bud_of_plant(const std::vector<VectorPoint>& points,
                                            const std::string& plant) {
  std::optional<Eigen::Vector3d> out;
  for (const VectorPoint& point : points) {
    if (point.label.plant == plant && point.label.organ == "bud" && (!out || point.x_m.z() < out->z()))
      out = point.x_m;
  }
  return out;
}

}  // namespace bpms
