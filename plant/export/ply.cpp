// PLY, binary little endian: vertices with normal and (s, t) = (U, V), faces with organ_id, material_id,
// plant_id. Comment lines name the organs and materials behind the numbers.
#include <algorithm>
#include <bit>
#include <cstring>
#include <iterator>

#include "plant/export/stand_parts.h"

namespace bpms {
namespace {

static_assert(std::endian::native == std::endian::little, "the bytes are written as they lie in memory");

template <class T>
void append(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

}  // namespace

std::string in_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, ' ');
  return text;
}

std::vector<MeshFile> ply_files(const std::string& path, const Mesh& mesh, int plant_id) {
  const MeshMaterials materials = mesh_materials(mesh);
  std::string out =
      "ply\nformat binary_little_endian 1.0\ncomment bpms plant, metres, z up; s along the organ, t across\n";
  const auto line = std::back_inserter(out);
  for (std::size_t i = 0; i < materials.names.size(); ++i)
    fmt::format_to(line, "comment material {} {}\n", i, materials.names[i]);
  for (const Mesh::Organ& organ : mesh.organs) {
    fmt::format_to(line, "comment organ {} {} {} {}\n", organ.id, organ.label, organ.kind, organ.material);
    for (const auto& property : organ.properties)
      fmt::format_to(line, "comment property {} {} {}\n", organ.id, in_one_line(property.first),
                     in_one_line(property.second));
  }
  fmt::format_to(line, "element vertex {}\n", mesh.positions_m.size());
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "s", "t"})
    fmt::format_to(line, "property float {}\n", name);
  fmt::format_to(line, "element face {}\nproperty list uchar int vertex_indices\n", mesh.triangles.size());
  for (const char* name : {"organ_id", "material_id", "plant_id"})
    fmt::format_to(line, "property int {}\n", name);
  out += "end_header\n";
  for (std::size_t i = 0; i < mesh.positions_m.size(); ++i) {
    for (const float value : mesh.positions_m[i]) append(out, value);
    for (const float value : mesh.normals[i]) append(out, value);
    for (const float value : mesh.uv[i]) append(out, value);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    append(out, std::uint8_t{3});
    for (const std::uint32_t vertex : mesh.triangles[t]) append(out, static_cast<std::int32_t>(vertex));
    const std::uint32_t organ = mesh.organ_of_triangle[t];
    append(out, static_cast<std::int32_t>(mesh.organs[organ].id));
    append(out, static_cast<std::int32_t>(materials.of_organ[organ]));
    append(out, static_cast<std::int32_t>(plant_id));
  }
  return {{path, std::move(out)}};
}

}  // namespace bpms
