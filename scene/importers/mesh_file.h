// Triangle meshes from files of other programs (OBJ, PLY and what else Assimp reads). Each of the file's
// groups becomes an organ; its kind is "leaf" where the name of its material or of the group says so.
#pragma once
#include <memory>
#include <string>

#include "plant/mesh.h"

namespace bpms {
// `metres_per_unit` scales the coordinates; y_up turns a file with y up (x, y, z) into (x, -z, y).
std::shared_ptr<const Mesh> read_mesh_file(const std::string& path, double metres_per_unit = 1,
                                           bool y_up = false);
}  // namespace bpms
