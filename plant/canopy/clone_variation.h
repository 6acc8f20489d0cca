// How the clones of a plant differ: their rotation about the vertical and their scale.
#pragma once
#include "core/random.h"
#include "core/toml.h"
#include "plant/canopy/pattern.h"

namespace bpms {

class CloneVariation {
 public:
  // The keys rotation and scale of a [[plants]] table.
  explicit CloneVariation(const TomlValue& plant);
  double rotation(Philox& random) const;  // radians
  double scale(Philox& random) const;

 private:
  enum class Rotation { uniform, fixed, von_mises } type_ = Rotation::uniform;
  double angle_ = 0;  // of fixed; mean of von_mises
  double kappa_ = 0;
  MeanSd scale_{1, 0};
};

}  // namespace bpms
