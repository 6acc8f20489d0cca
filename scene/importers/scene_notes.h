// What is allowed but probably a mistake, mostly of units: sizes that no organ has, and things a million
// times smaller than what is around them.
#pragma once
#include "scene/scene.h"

namespace bpms {
void note_implausible(Scene& scene);  // adds to scene.notes
}  // namespace bpms
