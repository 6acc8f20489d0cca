// A scene taken apart into its leaves and the rest, so that rays can look for one and pass the other. The
// terrain, if any, stays with both: where it hides the sky, neither is looked for. Ground planes are left out
// (rays start on them and look up).
#pragma once
#include "scene/scene.h"

namespace bpms {

enum class SceneSurface { leaves, others };
// What Prototype and Instance hold; meshes keep positions and triangles alone where they are divided.
Scene split_scene(const Scene& scene, SceneSurface keep);

}  // namespace bpms
