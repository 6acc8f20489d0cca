// Plants from files of any kind that is read: the plant language, MTG, OPF, L-systems and derived strings. To
// add a kind: its reader and one line in the table of exchange/plant_file.cpp.
#pragma once
#include <string>
#include <vector>

#include "plant/lsystem.h"
#include "plant/mesh_file.h"
#include "plant/mtg.h"
#include "plant/opf.h"

namespace bpms {

struct PlantFileOptions {
  double tolerance_m = 1e-4;
  bool lenient = false;         // of the plant language
  bool topology_alone = false;  // an MTG whose columns make no surface is read too, without a mesh
  MtgGeometryOptions mtg;       // its tolerance is the one above
  OpfOptions opf;
  std::optional<int> steps;  // of an L-system, instead of the file's
};

struct PlantFile {
  std::string name;
  Mesh mesh;
  Mtg mtg;
  std::vector<std::int32_t> organ_of_vertex;  // of the mesh; -1: none
  std::optional<LString> derived;             // of an L-system
  std::vector<std::string> notes, inputs;
};

bool is_plant_file(const std::string& path);  // by its extension
std::vector<std::string> plant_file_extensions();
PlantFile read_plant_file(const std::string& path, const PlantFileOptions& options = {});

// Files for an output path by its extension: a mesh, or .mtg, .opf; .lstr of L-systems.
std::vector<std::string> plant_file_paths(const std::string& path);
std::vector<MeshFile> plant_files(const std::string& path, const PlantFile& plant);

}  // namespace bpms
