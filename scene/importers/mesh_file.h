// Triangle meshes from files of other programs (OBJ, PLY, glTF and what else Assimp reads), node hierarchies
// flattened. Each of the file's groups becomes an organ; its kind is "leaf" where the name of its material or
// of the group says so. V runs upwards, so glTF's, which runs down, is turned round.
#pragma once
#include <memory>
#include <string>
#include <string_view>

#include "plant/mesh.h"

namespace bpms {
// `metres_per_unit` scales the coordinates; y_up turns a file with y up (x, y, z) into (x, -z, y).
std::shared_ptr<const Mesh> read_mesh_file(const std::string& path, double metres_per_unit = 1,
                                           bool y_up = false);
// The same from memory; `path` tells the format and what errors speak of. Nothing else is opened.
std::shared_ptr<const Mesh> parse_mesh(const std::string& path, std::string_view bytes,
                                       double metres_per_unit = 1, bool y_up = false);
// What a file's standard says (glTF: y); z where there is none.
bool mesh_file_is_y_up(const std::string& path);
// Does the name of a material or a group hold the word?
bool names_a_leaf(std::string_view name);
}  // namespace bpms
