// What the mesh formats share.
#pragma once
#include <Eigen/Core>

#include "core/error.h"
#include "plant/mesh_file.h"

namespace bpms {

std::vector<MeshFile> ply_files(const std::string& path, const Mesh& mesh, int plant_id);
std::vector<MeshFile> obj_files(const std::string& path, const Mesh& mesh, int plant_id);
std::vector<MeshFile> glb_files(const std::string& path, const Mesh& mesh, int plant_id);
std::string mtl_path(const std::string& obj_path);

// One organ's own vertices and triangles.
struct MeshOfOrgan {
  std::vector<std::uint32_t> vertices;                  // indices into the mesh
  std::vector<std::array<std::uint32_t, 3>> triangles;  // indices into `vertices`
};
std::vector<MeshOfOrgan> split_by_organ(const Mesh& mesh);

// A plain colour for viewers (linear RGB): plants have no colours, only material names.
Eigen::Vector3f viewer_colour(const std::string& material);

}  // namespace bpms
