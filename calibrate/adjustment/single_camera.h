// Each camera by itself: a lens and the pose of every target in every frame that it saw.
#pragma once
#include <map>
#include <utility>

#include "calibrate/adjustment/network.h"
#include "calibrate/lenses/lens.h"
#include "calibrate/observations.h"

namespace bpms {

struct SingleCamera {
  Camera camera;
  std::map<std::pair<int, int>, Pose> camera_from_target;  // of (frame, target)
};
SingleCamera single_camera(const BundleProblem& joint, int camera,
                           const Observations::ObservedCamera& observed, const LensChoice& lens);

}  // namespace bpms
