#include "calibrate/adjustment/blocks.h"

#include <algorithm>

#include "calibrate/adjustment/corner_term.h"
#include "calibrate/adjustment/knowledge_terms.h"
#include "calibrate/lenses/lens.h"

namespace bpms {
namespace {

using Kind = BlockId::Kind;

}  // namespace

Blocks::Blocks(const BundleProblem& problem, BundleState& state) : problem_(problem), state_(state) {
  for (int i = 0; i < static_cast<int>(problem.corners.size()); ++i)
    if (problem.corners[static_cast<std::size_t>(i)].used) add_corner(i);
  add_knowledge();
  add_beliefs();
}

std::vector<BlockId> Blocks::enter(const std::vector<BlockId>& ids) {
  for (const BlockId& id : ids) {
    const auto [at, fresh] = blocks_.try_emplace(id);
    if (!fresh) continue;
    Block& block = at->second;
    const auto a = static_cast<std::size_t>(id.a), b = static_cast<std::size_t>(id.b);
    block.size = 6;
    block.values = block.change.data();
    switch (id.kind) {
      case Kind::lens:
        block.values = state_.cameras[a].parameters.data();
        block.size = static_cast<int>(state_.cameras[a].parameters.size());
        block.held = find_lens(state_.cameras[a].model)
                         ->held({state_.cameras[a].parameters, state_.cameras[a].constants});
        if (a < problem_.held.size())
          block.held.insert(block.held.end(), problem_.held[a].begin(), problem_.held[a].end());
        break;
      case Kind::bending:
        block.values = state_.bending_m[a].data(), block.size = 2;
        break;
      case Kind::point:
        block.values = state_.shifts_m[a][b].data(), block.size = 3;
        break;
      case Kind::camera:
        block.start = camera_pose(state_.cameras[a]);
        break;
      case Kind::target:
        block.start = state_.world_from_target[a][b];
        // What a turn and a lift of the table would do as well.
        if (problem_.turntable() && id.a == problem_.datum) block.held = {2, 5};
        break;
      case Kind::rig:
        block.start = state_.rig_from_world[a];
        break;
    }
  }
  return ids;
}

void Blocks::add_corner(int index) {
  const CornerObservation& corner = problem_.corners[static_cast<std::size_t>(index)];
  const NetworkTarget& target = problem_.targets[static_cast<std::size_t>(corner.target)];
  CornerBlocks blocks;
  std::vector<BlockId> ids;
  const auto want = [&](bool& flag, bool wanted, const BlockId& id) {
    flag = wanted;
    if (wanted) ids.push_back(id);
  };
  want(blocks.lens, problem_.free_lenses, {Kind::lens, corner.camera});
  want(blocks.camera, problem_.free_camera_poses && corner.camera > 0, {Kind::camera, corner.camera});
  want(blocks.rig, problem_.rig_moves, {Kind::rig, static_cast<int>(problem_.rig_slot(corner.frame))});
  want(blocks.target, !(problem_.rig_moves && !problem_.turntable() && corner.target == problem_.datum),
       {Kind::target, corner.target, static_cast<int>(problem_.slot(corner.target, corner.frame))});
  want(blocks.bending, !target.bending.empty(), {Kind::bending, corner.target});
  want(blocks.point, target.known != PointsKnown::exact, {Kind::point, corner.target, corner.point});
  terms_.push_back({corner_term(problem_, state_, corner, blocks), enter(ids), index});
}

// Only of points that corners see: the others are not estimated.
void Blocks::add_knowledge() {
  for (int t = 0; t < static_cast<int>(problem_.targets.size()); ++t) {
    const NetworkTarget& target = problem_.targets[static_cast<std::size_t>(t)];
    if (target.known == PointsKnown::exact || target.known == PointsKnown::unknown) continue;
    std::vector<BlockId> seen;
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < static_cast<int>(target.points_m.size()); ++i) {
      if (!blocks_.contains({Kind::point, t, i})) continue;
      seen.push_back({Kind::point, t, i});
      points.push_back(target.points_m[static_cast<std::size_t>(i)]);
    }
    if (seen.empty()) continue;
    bool bars = false;
    for (const ScaleBar& bar : target.bars) {
      const BlockId a{Kind::point, t, bar.a}, b{Kind::point, t, bar.b};
      if (!blocks_.contains(a) || !blocks_.contains(b)) continue;
      bars = true;
      terms_.push_back({scale_bar_term(bar, target.points_m[static_cast<std::size_t>(bar.a)],
                                       target.points_m[static_cast<std::size_t>(bar.b)], problem_.sigma_px),
                        {a, b}});
    }
    if (target.known == PointsKnown::free)
      terms_.push_back({inner_constraints(points, !bars, problem_.sigma_px), seen});
    for (const BlockId& id : seen) {
      if (target.known == PointsKnown::surveyed)
        terms_.push_back(
            {surveyed_point_term(target.covariance_m2[static_cast<std::size_t>(id.b)], problem_.sigma_px),
             {id}});
    }
  }
}

void Blocks::add_beliefs() {
  for (int c = 0; c < static_cast<int>(state_.cameras.size()); ++c) {
    const BlockId id{Kind::lens, c};
    if (!blocks_.contains(id)) continue;
    const Camera& camera = state_.cameras[static_cast<std::size_t>(c)];
    auto priors = find_lens(camera.model)->priors({camera.parameters, camera.constants});
    if (priors.empty()) continue;
    terms_.push_back(
        {lens_prior_term(std::move(priors), camera.parameters.size(), problem_.sigma_px), {id}, -1, true});
  }
}

void Blocks::store() {
  for (auto& [id, block] : blocks_) {
    if (block.values != block.change.data()) continue;
    const Eigen::Map<const Eigen::Vector3d> w(block.change.data()), t(block.change.data() + 3);
    const Pose pose{orthonormalised(rotation_from_vector(w) * block.start.r), block.start.t_m + t};
    const auto a = static_cast<std::size_t>(id.a), b = static_cast<std::size_t>(id.b);
    if (id.kind == Kind::camera)
      set_pose(state_.cameras[a], pose);
    else if (id.kind == Kind::target)
      state_.world_from_target[a][b] = pose;
    else
      state_.rig_from_world[a] = pose;
  }
}

}  // namespace bpms
