#include "plant/mesh_file.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "core/nearest.h"
#include "plant/export/formats.h"

namespace bpms {
namespace {

struct MeshFormat {
  std::string_view extension;
  std::vector<MeshFile> (*files)(const std::string& path, const Mesh& mesh, int plant_id);
  std::string (*companion)(const std::string& path);  // a second file's path, or null
};
constexpr MeshFormat formats[] = {
    {".ply", ply_files, nullptr},
    {".obj", obj_files, mtl_path},
    {".glb", glb_files, nullptr},
};

const MeshFormat& format_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::vector<std::string> known;
  for (const MeshFormat& format : formats) {
    if (format.extension == extension) return format;
    known.emplace_back(format.extension);
  }
  bad_input({path}, "unknown kind of mesh file {}{}", in_quotes(extension), did_you_mean(extension, known));
}

}  // namespace

std::vector<MeshFile> mesh_files(const std::string& path, const Mesh& mesh, int plant_id) {
  return format_of(path).files(path, mesh, plant_id);
}

std::vector<std::string> mesh_file_paths(const std::string& path) {
  const MeshFormat& format = format_of(path);
  std::vector<std::string> out{path};
  if (format.companion != nullptr) out.push_back(format.companion(path));
  return out;
}

MeshMaterials mesh_materials(const Mesh& mesh) {
  MeshMaterials out;
  std::map<std::string, std::uint32_t> index;
  for (const Mesh::Organ& organ : mesh.organs) {
    const auto [at, fresh] = index.try_emplace(organ.material, static_cast<std::uint32_t>(index.size()));
    if (fresh) out.names.push_back(organ.material);
    out.of_organ.push_back(at->second);
  }
  return out;
}

std::vector<MeshOfOrgan> split_by_organ(const Mesh& mesh) {
  constexpr std::uint32_t unseen = 0xffffffffu;
  std::vector<MeshOfOrgan> out(mesh.organs.size());
  std::vector<std::uint32_t> local(mesh.positions_m.size(), unseen);
  std::vector<std::uint32_t> owner(mesh.positions_m.size(), unseen);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t organ = mesh.organ_of_triangle[t];
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t vertex = mesh.triangles[t][k];
      if (owner[vertex] != organ) {  // not met yet by this organ
        owner[vertex] = organ;
        local[vertex] = static_cast<std::uint32_t>(out[organ].vertices.size());
        out[organ].vertices.push_back(vertex);
      }
      corners[k] = local[vertex];
    }
    out[organ].triangles.push_back(corners);
  }
  return out;
}

Eigen::Vector3f viewer_colour(const std::string& material) {
  const auto named = [&](std::string_view word) { return material.find(word) != std::string::npos; };
  if (named("dead") || named("senescent")) return {0.48f, 0.31f, 0.10f};
  if (named("leaf")) return {0.13f, 0.36f, 0.08f};
  if (named("stem")) return {0.30f, 0.42f, 0.14f};
  if (named("head")) return {0.60f, 0.47f, 0.18f};
  if (named("bark")) return {0.25f, 0.17f, 0.11f};
  return {0.40f, 0.40f, 0.35f};
}

}  // namespace bpms
