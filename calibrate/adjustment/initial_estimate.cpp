#include "calibrate/adjustment/initial_estimate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "calibrate/adjustment/single_camera.h"
#include "core/parallel.h"
#include "core/statistics.h"

namespace bpms {
namespace {

double distance(const Pose& a, const Pose& b, double metres_per_radian) {
  return (a.t_m - b.t_m).norm() + metres_per_radian * vector_from_rotation(a.r * b.r.transpose()).norm();
}

// The candidate with the least median distance to the others.
Pose medoid(std::vector<Pose> candidates) {
  constexpr std::size_t most = 200;  // the cost rises with the square
  for (std::size_t i = 0; candidates.size() > most && i < most; ++i)
    candidates[i] = candidates[i * candidates.size() / most];
  candidates.resize(std::min(candidates.size(), most));
  double size = 0;
  for (const Pose& pose : candidates) size = std::max(size, pose.t_m.norm());
  std::size_t best = 0;
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    std::vector<double> distances;
    for (const Pose& other : candidates) distances.push_back(distance(candidates[i], other, size));
    const double middle = median(std::move(distances));
    if (middle < least) least = middle, best = i;
  }
  return candidates[best];
}

// Poses become known one after the other: of the three in C_camera R_frame T_target, what a view tells, the
// third follows from two.
class Joining {
 public:
  Joining(const BundleProblem& problem, const std::vector<SingleCamera>& alone, BundleState& state)
      : problem_(problem), alone_(alone), state_(state) {
    for (const CornerObservation& corner : problem.corners) {
      corners_of_frame_[corner.frame].push_back(corner);
      corners_of_target_[slot_of(corner.target, corner.frame)].push_back(corner);
    }
    seed();
  }

  void run() {
    for (std::size_t round = 0; round < alone_.size(); ++round) {
      while (place()) {
      }
      if (!add_camera()) break;
    }
    while (place()) {
    }
    require_all();
    place_anew();
    to_first_camera();
  }
  bool placed(const CornerObservation& corner) const {
    return frame_known(corner.frame) && targets_.contains(slot_of(corner.target, corner.frame));
  }

 private:
  using Slot = std::pair<int, std::size_t>;
  Slot slot_of(int target, int frame) const { return {target, problem_.slot(target, frame)}; }
  Pose camera(int c) const { return camera_pose(state_.cameras[static_cast<std::size_t>(c)]); }
  Pose frame(int f) const {
    return problem_.rig_moves ? state_.rig_from_world[static_cast<std::size_t>(f)] : Pose{};
  }
  Pose target(const Slot& slot) const {
    return state_.world_from_target[static_cast<std::size_t>(slot.first)][slot.second];
  }
  bool frame_known(int f) const { return !problem_.rig_moves || frames_.contains(f); }

  // The camera that sees the most of the datum begins; camera 0 where there is none.
  void seed() {
    std::size_t first = 0, most = 0;
    for (std::size_t c = 0; problem_.rig_moves && c < alone_.size(); ++c) {
      std::size_t seen = 0;
      for (const auto& [key, pose] : alone_[c].camera_from_target)
        seen += key.second == problem_.datum ? 1 : 0;
      if (seen > most) most = seen, first = c;
    }
    cameras_.insert(static_cast<int>(first));
    if (problem_.rig_moves) targets_.insert({problem_.datum, 0});
  }

  // Of each view whose camera is known.
  template <class Visit>
  void visit_views(const Visit& visit) const {
    for (const int c : cameras_)
      for (const auto& [key, pose] : alone_[static_cast<std::size_t>(c)].camera_from_target)
        visit(c, key.first, slot_of(key.second, key.first), pose);
  }

  double cost(const std::vector<CornerObservation>& corners) const {
    double sum = 0;
    for (const CornerObservation& corner : corners) {
      if (!cameras_.contains(corner.camera) || !frame_known(corner.frame) ||
          !targets_.contains(slot_of(corner.target, corner.frame)))
        continue;
      const auto r = residual(problem_, state_, corner);
      constexpr double nowhere_px = 1e4;
      sum += std::log1p(r ? r->squaredNorm() : nowhere_px * nowhere_px);  // Cauchy's loss at 1 px
    }
    return sum;
  }

  // The candidate that suits all views of it best: a view found wrongly must not place it for all.
  void settle(Pose& place, std::vector<Pose> candidates, const std::vector<CornerObservation>& corners) {
    constexpr std::size_t most = 16;  // of a target that stands and is seen in many frames
    if (candidates.size() > most) candidates.push_back(medoid(candidates));
    double least = HUGE_VAL;
    Pose best = candidates.front();
    const std::size_t step = std::max<std::size_t>(1, candidates.size() / most);
    for (std::size_t i = candidates.size(); i-- > 0;) {
      if (i % step != 0 && i + 1 != candidates.size()) continue;
      place = candidates[i];
      const double now = cost(corners);
      if (now < least) least = now, best = candidates[i];
    }
    place = best;
  }

  // Frames, then targets, that follow from what is known; true when there were any.
  bool place() {
    std::map<int, std::vector<Pose>> frames;
    std::map<Slot, std::vector<Pose>> targets;
    visit_views([&](int c, int f, const Slot& slot, const Pose& pose) {
      if (!frame_known(f) && targets_.contains(slot))
        frames[f].push_back(camera(c).inverse() * pose * target(slot).inverse());
      else if (frame_known(f) && !targets_.contains(slot))
        targets[slot].push_back((camera(c) * frame(f)).inverse() * pose);
    });
    for (auto& [f, candidates] : frames) settle_frame(f, std::move(candidates));
    for (auto& [slot, candidates] : targets) settle_target(slot, std::move(candidates));
    return !frames.empty() || !targets.empty();
  }
  void settle_frame(int f, std::vector<Pose> candidates) {
    frames_.insert(f);
    settle(state_.rig_from_world[static_cast<std::size_t>(f)], std::move(candidates),
           corners_of_frame_.at(f));
  }
  void settle_target(const Slot& slot, std::vector<Pose> candidates) {
    targets_.insert(slot);
    settle(state_.world_from_target[static_cast<std::size_t>(slot.first)][slot.second], std::move(candidates),
           corners_of_target_.at(slot));
  }

  // The one with the most views of what is known.
  bool add_camera() {
    int best = -1;
    std::vector<Pose> most;
    for (int c = 0; c < static_cast<int>(alone_.size()); ++c) {
      if (cameras_.contains(c)) continue;
      std::vector<Pose> candidates;
      for (const auto& [key, pose] : alone_[static_cast<std::size_t>(c)].camera_from_target) {
        const Slot slot = slot_of(key.second, key.first);
        if (frame_known(key.first) && targets_.contains(slot))
          candidates.push_back(pose * (frame(key.first) * target(slot)).inverse());
      }
      if (candidates.size() > most.size()) most = std::move(candidates), best = c;
    }
    if (best < 0) return false;
    cameras_.insert(best);
    set_pose(state_.cameras[static_cast<std::size_t>(best)], medoid(std::move(most)));
    return true;
  }

  void require_all() const {
    for (int c = 0; c < static_cast<int>(alone_.size()); ++c) {
      if (cameras_.contains(c)) continue;
      bad_input(
          {},
          "camera {} shares no frame with {}: the cameras' images of one moment must carry the same digits",
          in_quotes(state_.cameras[static_cast<std::size_t>(c)].name),
          in_quotes(state_.cameras[static_cast<std::size_t>(*cameras_.begin())].name));
    }
  }

  // With all cameras known, what was placed by the first of them is looked at again.
  void place_anew() {
    std::map<int, std::vector<Pose>> frames;
    visit_views([&](int c, int f, const Slot& slot, const Pose& pose) {
      if (problem_.rig_moves && targets_.contains(slot))
        frames[f].push_back(camera(c).inverse() * pose * target(slot).inverse());
    });
    for (auto& [f, candidates] : frames) settle_frame(f, std::move(candidates));
    std::map<Slot, std::vector<Pose>> targets;
    visit_views([&](int c, int f, const Slot& slot, const Pose& pose) {
      if (frame_known(f) && !(problem_.rig_moves && slot.first == problem_.datum))
        targets[slot].push_back((camera(c) * frame(f)).inverse() * pose);
    });
    for (auto& [slot, candidates] : targets) settle_target(slot, std::move(candidates));
  }

  // The rig's frame is camera 0's.
  void to_first_camera() {
    const Pose first = camera(0);
    for (Camera& c : state_.cameras) set_pose(c, camera_pose(c) * first.inverse());
    if (problem_.rig_moves) {
      for (Pose& pose : state_.rig_from_world) pose = first * pose;
      return;
    }
    for (auto& slots : state_.world_from_target)
      for (Pose& pose : slots) pose = first * pose;
  }

  const BundleProblem& problem_;
  const std::vector<SingleCamera>& alone_;
  BundleState& state_;
  std::map<int, std::vector<CornerObservation>> corners_of_frame_;
  std::map<Slot, std::vector<CornerObservation>> corners_of_target_;
  std::set<int> cameras_, frames_;  // what is known
  std::set<Slot> targets_;
};

}  // namespace

BundleState initial_estimate(BundleProblem& problem, const std::vector<Observations::ObservedCamera>& cameras,
                             const LensChoice& lens) {
  std::vector<SingleCamera> alone(cameras.size());
  parallel_for(cameras.size(), [&](std::size_t c) {
    alone[c] = single_camera(problem, static_cast<int>(c), cameras[c], lens);
  });
  std::vector<Camera> start;
  for (const SingleCamera& one : alone) start.push_back(one.camera);
  BundleState joint = empty_state(problem, std::move(start));
  Joining joining(problem, alone, joint);
  joining.run();
  for (CornerObservation& corner : problem.corners) corner.placed = joining.placed(corner);
  return joint;
}

}  // namespace bpms
