// Wavefront OBJ: one group an organ, its material from the MTL file of the same name beside it.
#include <cmath>
#include <filesystem>
#include <iterator>

#include "plant/export/stand_parts.h"

namespace bpms {

std::string mtl_path(const std::string& obj_path) {
  return std::filesystem::path(obj_path).replace_extension(".mtl").string();
}

std::string mtl_text(const std::vector<std::string>& materials) {
  std::string out = "# bpms materials; colours are for viewers only\n";
  for (const std::string& name : materials) {
    const Eigen::Vector3f linear = viewer_colour(name);
    const auto shown = [](float value) {
      return std::pow(value, 1 / 2.2f);
    };  // MTL colours are display-referred
    fmt::format_to(std::back_inserter(out), "newmtl {}\nKd {:.3f} {:.3f} {:.3f}\nillum 1\n", name,
                   shown(linear.x()), shown(linear.y()), shown(linear.z()));
  }
  return out;
}

std::vector<MeshFile> obj_files(const std::string& path, const Mesh& mesh, int plant_id) {
  const MeshMaterials materials = mesh_materials(mesh);
  const std::string library = mtl_path(path);
  std::string out = "# bpms plant, metres, z up; vt = U along the organ, V across\n";
  const auto line = std::back_inserter(out);
  fmt::format_to(line, "mtllib {}\no plant{}\n", std::filesystem::path(library).filename().string(),
                 plant_id);
  for (const Eigen::Vector3f& p : mesh.positions_m) fmt::format_to(line, "v {} {} {}\n", p.x(), p.y(), p.z());
  for (const Eigen::Vector2f& t : mesh.uv) fmt::format_to(line, "vt {} {}\n", t.x(), t.y());
  for (const Eigen::Vector3f& n : mesh.normals) fmt::format_to(line, "vn {} {} {}\n", n.x(), n.y(), n.z());
  std::uint32_t organ = 0;
  bool first = true;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (first || mesh.organ_of_triangle[t] != organ) {
      organ = mesh.organ_of_triangle[t];
      first = false;
      fmt::format_to(line, "g {}\nusemtl {}\n", mesh.organs[organ].label, mesh.organs[organ].material);
    }
    const auto& [a, b, c] = mesh.triangles[t];
    fmt::format_to(line, "f {0}/{0}/{0} {1}/{1}/{1} {2}/{2}/{2}\n", a + 1, b + 1, c + 1);
  }
  return {{path, std::move(out)}, {library, mtl_text(materials.names)}};
}

}  // namespace bpms
