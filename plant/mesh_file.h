// Meshes as files that other programs open: PLY (binary), OBJ with its MTL, GLB (glTF 2.0). Metres; z up, but
// y up in GLB, as glTF demands. Every format keeps organs, materials, normals and (U, V). To add a format:
// one file export/NAME.cpp and one line in the table of export/mesh_file.cpp.
#pragma once
#include <string>
#include <vector>

#include "plant/mesh.h"

namespace bpms {

// A file to write: its name and its bytes. OBJ needs two.
struct MeshFile {
  std::string path;
  std::string bytes;
};
// The files for an output path, by its extension; bad_input for an unknown one.
std::vector<MeshFile> mesh_files(const std::string& path, const Mesh& mesh, int plant_id = 0);
// The paths that mesh_files() would give, to be checked before long work.
std::vector<std::string> mesh_file_paths(const std::string& path);

// Names of the mesh's materials in order of first use, and each organ's index into them.
struct MeshMaterials {
  std::vector<std::string> names;
  std::vector<std::uint32_t> of_organ;
};
MeshMaterials mesh_materials(const Mesh& mesh);

}  // namespace bpms
