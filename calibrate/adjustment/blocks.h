// The parameters of an adjustment in blocks, as the solver moves them, and the terms of its cost. The same
// terms make the solver's steps and the covariance.
#pragma once
#include <ceres/cost_function.h>

#include <array>
#include <compare>
#include <map>
#include <memory>
#include <vector>

#include "calibrate/adjustment/network.h"

namespace bpms {

struct BlockId {
  enum class Kind { lens, camera, bending, target, point, rig };
  Kind kind = Kind::lens;
  int a = 0;  // camera, target or frame
  int b = 0;  // slot or point
  auto operator<=>(const BlockId&) const = default;
};

// Poses are moved by a small left rotation and a translation about the pose at the start, which keeps the
// rotation vector far from its singular angle.
struct Block {
  double* values = nullptr;
  int size = 0;
  std::vector<int> held = {};      // of the values: not estimated
  std::array<double, 6> change{};  // of a pose: rotation vector, then translation
  Pose start = {};
};

struct Term {
  std::unique_ptr<ceres::CostFunction> cost;
  std::vector<BlockId> blocks;
  int corner = -1;  // -1: what is known beforehand
  // No measurement, but what is believed of a lens: it keeps parameters from wandering where no corner is,
  // and does not count as an observation.
  bool belief = false;
};

class Blocks {
 public:
  // Of the used corners. Moves the values of `state` itself, but for poses: store() puts those back.
  Blocks(const BundleProblem& problem, BundleState& state);
  Blocks(const Blocks&) = delete;
  Blocks& operator=(const Blocks&) = delete;

  const std::map<BlockId, Block>& all() const { return blocks_; }
  const std::vector<Term>& terms() const { return terms_; }
  void store();

 private:
  void add_corner(int index);
  void add_knowledge();
  void add_beliefs();
  std::vector<BlockId> enter(const std::vector<BlockId>& ids);

  const BundleProblem& problem_;
  BundleState& state_;
  std::map<BlockId, Block> blocks_;
  std::vector<Term> terms_;
};

}  // namespace bpms
