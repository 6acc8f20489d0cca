// Reflectance and transmittance of materials as the structure report wants them, from [materials] and [bands]
// of a scene.
#pragma once
#include <string>
#include <vector>

#include "plant/structure/area_scattering.h"

namespace bpms {

struct SceneOptics {
  std::vector<BandOptics> bands;
  std::vector<std::string> inputs;  // files that were read
  std::vector<std::string> notes;   // what is left out
};
// The diffuse part of each material: the mean reflectance of its two faces, and its transmittance. A name
// without a table is bad_input.
SceneOptics read_leaf_optics(const std::string& scene_file, const std::vector<std::string>& materials);

}  // namespace bpms
