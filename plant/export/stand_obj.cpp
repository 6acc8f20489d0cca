// A stand as one OBJ: an object a clone, a group an organ.
#include <filesystem>
#include <iterator>

#include "plant/export/stand_parts.h"

namespace bpms {

void write_stand_obj(const std::string& path, const Stand& stand, const StandFileOptions& options) {
  const StandMaterials materials(stand);
  const std::string library = mtl_path(path);
  FileStream out(path, options.overwrite);
  out.buffer() += fmt::format("# bpms stand, metres, z up; vt = U along the organ, V across\nmtllib {}\n",
                              std::filesystem::path(library).filename().string());
  std::size_t first = 1, plant = 0;
  for (const StandItem& item : stand.items) {
    const Mesh& mesh = *stand.meshes[item.mesh];
    const Eigen::Affine3f place = item.world_from_plant.cast<float>();
    const Eigen::Matrix3f turn = item.world_from_plant.rotation().cast<float>();
    fmt::format_to(std::back_inserter(out.buffer()), "o {}_{}\n", stand.names[item.mesh], plant++);
    for (std::size_t v = 0; v < mesh.positions_m.size(); ++v) {
      const Eigen::Vector3f p = place * mesh.positions_m[v], n = turn * mesh.normals[v];
      fmt::format_to(std::back_inserter(out.buffer()), "v {} {} {}\nvt {} {}\nvn {} {} {}\n", p.x(), p.y(),
                     p.z(), mesh.uv[v].x(), mesh.uv[v].y(), n.x(), n.y(), n.z());
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Mesh::Organ& organ = mesh.organs[mesh.organ_of_triangle[t]];
      if (t == 0 || mesh.organ_of_triangle[t] != mesh.organ_of_triangle[t - 1])
        fmt::format_to(std::back_inserter(out.buffer()), "g {}\nusemtl {}\n", organ.label, organ.material);
      fmt::format_to(std::back_inserter(out.buffer()), "f {0}/{0}/{0} {1}/{1}/{1} {2}/{2}/{2}\n",
                     first + mesh.triangles[t][0], first + mesh.triangles[t][1],
                     first + mesh.triangles[t][2]);
    }
    first += mesh.positions_m.size();
  }
  out.commit();
  write_file(library, mtl_text(materials.names), options.overwrite);
}

}  // namespace bpms
