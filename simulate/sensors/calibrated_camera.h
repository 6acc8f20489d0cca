// A perspective sensor with the lens, the size and, where asked, the pose of a camera of a rig.toml:
//   rig = "rig.toml", camera = "left"         lens and size
//   scene_from_rig = [[r r r t], ...]         3x4, X_scene = R X_rig + t: the camera stands as in the rig
//   location, look_at or direction, up        or it stands by itself
#pragma once
#include "simulate/sensors/perspective.h"

namespace bpms {
void read_calibrated_camera(const TomlValue& table, const SensorContext& context, PerspectiveSensor& out);
}  // namespace bpms
