// Stands as files that other programs open: plants' meshes and where each clone stands. GLB keeps every mesh
// once and refers to it; PLY and OBJ have every triangle written out, streamed to disk, so that memory does
// not grow with the stand; OPS is the list of places. Metres, z up (y up in GLB, as glTF demands).
#pragma once
#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "plant/canopy.h"
#include "plant/mesh.h"
#include "plant/opf.h"

namespace bpms {

struct StandItem {
  std::uint32_t mesh = 0;
  Eigen::Affine3d world_from_plant = Eigen::Affine3d::Identity();  // a rotation, one scale, a translation
};

struct Stand {
  std::vector<std::shared_ptr<const Mesh>> meshes;
  std::vector<std::string> names, files;  // of each mesh
  std::vector<StandItem> items;
  OpsScene places;  // the same as a list, with paths relative to where it will be written
};

Stand canopy_stand(const Canopy& canopy, double tolerance_m = 1e-4);
// The plants of an OPS file, read by `read_mesh` from paths relative to it.
Stand ops_stand(const std::string& path,
                const std::function<std::shared_ptr<const Mesh>(const std::string& file)>& read_mesh);

// By the extension: .glb, .ply, .obj (with its .mtl), .ops; bad_input for others.
std::vector<std::string> stand_file_paths(const std::string& path);
struct StandFileOptions {
  bool overwrite = false;
  // More clones than this are instanced in GLB (EXT_mesh_gpu_instancing, declared as required: a viewer
  // without it says so instead of showing one plant of each kind).
  std::size_t most_nodes = 2000;
};
void write_stand(const std::string& path, const Stand& stand, const StandFileOptions& options = {});

}  // namespace bpms
