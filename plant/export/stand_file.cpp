#include "plant/stand_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/nearest.h"
#include "plant/export/stand_parts.h"
#include "plant/plant_mesh.h"

namespace bpms {
namespace {

void write_stand_ops(const std::string& path, const Stand& stand, const StandFileOptions& options) {
  OpsScene places = stand.places;
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  for (OpsRow& row : places.rows)
    row.file = std::filesystem::absolute(row.file).lexically_normal().lexically_relative(folder).string();
  write_file(path, ops_text(places), options.overwrite);
}

struct StandFormat {
  std::string_view extension;
  void (*write)(const std::string& path, const Stand& stand, const StandFileOptions& options);
  std::string (*companion)(const std::string& path);
};
constexpr StandFormat stand_formats[] = {{".glb", write_stand_glb, nullptr},
                                         {".ply", write_stand_ply, nullptr},
                                         {".obj", write_stand_obj, mtl_path},
                                         {".ops", write_stand_ops, nullptr}};

const StandFormat& stand_format_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  std::vector<std::string> known;
  for (const StandFormat& format : stand_formats) {
    if (format.extension == extension) return format;
    known.emplace_back(format.extension);
  }
  bad_input({path}, "unknown kind of file for a stand {}{}", in_quotes(extension),
            did_you_mean(extension, known));
}

}  // namespace

StandMaterials::StandMaterials(const Stand& stand) {
  std::map<std::string, std::uint32_t> index;
  for (const auto& mesh : stand.meshes) {
    of_organ.emplace_back();
    for (const Mesh::Organ& organ : mesh->organs) {
      const auto at = index.try_emplace(organ.material, static_cast<std::uint32_t>(index.size()));
      if (at.second) names.push_back(organ.material);
      of_organ.back().push_back(at.first->second);
    }
  }
}

Stand canopy_stand(const Canopy& canopy, double tolerance_m) {
  Stand out;
  for (const CanopyPlant& plant : canopy.plants) {
    out.meshes.push_back(plant.mesh ? plant.mesh
                                    : std::make_shared<const Mesh>(plant_mesh(*plant.plant, {tolerance_m})));
    out.names.push_back(std::filesystem::path(plant.file).stem().string());
    out.files.push_back(plant.file);
  }
  out.places.origin_m = {-canopy.size_m.x() / 2, -canopy.size_m.y() / 2, 0};
  out.places.size_m = canopy.size_m;
  for (const Placement& p : canopy.placements) {
    OpsRow row;
    row.plant = static_cast<long long>(out.items.size()) + 1;
    row.file = canopy.plants[p.plant].file;
    row.position_m = p.position_m;
    row.scale = p.scale;
    row.twist = p.rotation;
    row.lean = std::acos(std::clamp(static_cast<double>(p.up.z()), -1.0, 1.0));
    row.lean_azimuth = row.lean > 0 ? std::atan2(p.up.y(), p.up.x()) : 0;
    row.group = out.names[p.plant];
    out.items.push_back({p.plant, row.world_from_plant()});
    out.places.rows.push_back(std::move(row));
  }
  return out;
}

Stand ops_stand(const std::string& path,
                const std::function<std::shared_ptr<const Mesh>(const std::string& file)>& read_mesh) {
  Stand out;
  out.places = read_ops(path);
  std::map<std::string, std::uint32_t> numbers;
  for (OpsRow& row : out.places.rows) {
    row.file = (std::filesystem::path(path).parent_path() / row.file).lexically_normal().string();
    const auto at = numbers.try_emplace(row.file, static_cast<std::uint32_t>(numbers.size()));
    if (at.second) {
      out.meshes.push_back(read_mesh(row.file));
      out.names.push_back(std::filesystem::path(row.file).stem().string());
      out.files.push_back(row.file);
    }
    out.items.push_back({at.first->second, row.world_from_plant()});
  }
  return out;
}

std::vector<std::string> stand_file_paths(const std::string& path) {
  const StandFormat& format = stand_format_of(path);
  std::vector<std::string> out{path};
  if (format.companion != nullptr) out.push_back(format.companion(path));
  return out;
}

void write_stand(const std::string& path, const Stand& stand, const StandFileOptions& options) {
  stand_format_of(path).write(path, stand, options);
}

}  // namespace bpms
