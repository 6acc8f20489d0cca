// A stand as one PLY: as that of a plant, with plant_id the number of the clone.
#include <limits>

#include "plant/export/stand_parts.h"

namespace bpms {
namespace {

#pragma pack(push, 1)
struct PlyFace {
  std::uint8_t count = 3;
  std::int32_t corners[3];
  std::int32_t organ = 0, material = 0, plant = 0;
};
#pragma pack(pop)
static_assert(sizeof(PlyFace) == 25, "a PLY face as its header says");

std::string ply_stand_header(const Stand& stand, const StandMaterials& materials, std::size_t vertices,
                             std::size_t faces) {
  std::string out =
      "ply\nformat binary_little_endian 1.0\ncomment bpms stand, metres, z up; s along the organ, t across\n";
  for (std::size_t i = 0; i < materials.names.size(); ++i)
    out += fmt::format("comment material {} {}\n", i, in_one_line(materials.names[i]));
  for (std::size_t p = 0; p < stand.meshes.size(); ++p) {
    out += fmt::format("comment kind {} {}\n", p, in_one_line(stand.names[p]));
    for (const Mesh::Organ& organ : stand.meshes[p]->organs) {
      out +=
          fmt::format("comment organ {} {} {} {} {}\n", p, organ.id, organ.label, organ.kind, organ.material);
      for (const auto& property : organ.properties)
        out += fmt::format("comment property {} {} {} {}\n", p, organ.id, in_one_line(property.first),
                           in_one_line(property.second));
    }
  }
  constexpr std::size_t most_clones_named = 100'000;
  for (std::size_t i = 0; i < std::min(stand.items.size(), most_clones_named); ++i)
    out += fmt::format("comment plant {} {}\n", i, stand.items[i].mesh);
  out += fmt::format("element vertex {}\n", vertices);
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "s", "t"})
    out += fmt::format("property float {}\n", name);
  out += fmt::format("element face {}\nproperty list uchar int vertex_indices\n", faces);
  for (const char* name : {"organ_id", "material_id", "plant_id"})
    out += fmt::format("property int {}\n", name);
  return out + "end_header\n";
}

}  // namespace

void write_stand_ply(const std::string& path, const Stand& stand, const StandFileOptions& options) {
  const StandMaterials materials(stand);
  std::size_t vertices = 0, faces = 0;
  for (const StandItem& item : stand.items) {
    vertices += stand.meshes[item.mesh]->positions_m.size();
    faces += stand.meshes[item.mesh]->triangles.size();
  }
  if (vertices > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    bad_input({path}, "{} vertices, PLY can number 2147483647: write GLB, which keeps each plant once",
              vertices);
  FileStream out(path, options.overwrite);
  out.buffer() += ply_stand_header(stand, materials, vertices, faces);
  for (const StandItem& item : stand.items) {
    const Mesh& mesh = *stand.meshes[item.mesh];
    const Eigen::Matrix3f turn_and_scale = item.world_from_plant.linear().cast<float>();
    const Eigen::Vector3f moved = item.world_from_plant.translation().cast<float>();
    const Eigen::Matrix3f turn = item.world_from_plant.rotation().cast<float>();
    for (std::size_t v = 0; v < mesh.positions_m.size(); ++v) {
      Eigen::Matrix<float, 8, 1> row;
      row.head<3>() = turn_and_scale * mesh.positions_m[v] + moved;
      row.segment<3>(3) = turn * mesh.normals[v];
      row.tail<2>() = mesh.uv[v];
      out.append(row.data(), 8);
    }
  }
  std::int32_t first = 0, plant = 0;
  for (const StandItem& item : stand.items) {
    const Mesh& mesh = *stand.meshes[item.mesh];
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      PlyFace face;
      for (std::size_t k = 0; k < 3; ++k)
        face.corners[k] = first + static_cast<std::int32_t>(mesh.triangles[t][k]);
      const std::uint32_t organ = mesh.organ_of_triangle[t];
      face.organ = mesh.organs[organ].id;
      face.material = static_cast<std::int32_t>(materials.of_organ[item.mesh][organ]);
      face.plant = plant;
      out.append(&face, 1);
    }
    first += static_cast<std::int32_t>(mesh.positions_m.size());
    ++plant;
  }
  out.commit();
}

}  // namespace bpms
