#include "plant/plant_file.h"

#include <algorithm>
#include <filesystem>
#include <unordered_map>

#include "core/nearest.h"
#include "plant/plant_mesh.h"

namespace bpms {
namespace {

std::string plant_extension(const std::string& path) {
  std::string out = std::filesystem::path(path).extension().string();
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::tolower(c); });
  return out;
}

// Which organ each vertex is, by the labels that the graph carries.
std::vector<std::int32_t> organs_by_label(const Mesh& mesh, const Mtg& mtg) {
  std::unordered_map<std::string, std::int32_t> numbers;
  for (std::size_t i = 0; i < mesh.organs.size(); ++i)
    numbers.emplace(mesh.organs[i].label, static_cast<std::int32_t>(i));
  std::vector<std::int32_t> out(mtg.vertices.size(), -1);
  const auto label = mtg.feature("Label");
  for (std::size_t v = 0; label && v < out.size(); ++v) {
    const std::string* text = mtg.text(v, *label);
    const auto found = text != nullptr ? numbers.find(*text) : numbers.end();
    if (found != numbers.end()) out[v] = found->second;
  }
  return out;
}

void read_bpms_plant(const std::string& path, const PlantFileOptions& options, PlantFile& out) {
  const Plant plant = read_plant(path, {options.lenient});
  out.name = plant.name;
  out.notes = plant.warnings;
  out.inputs = plant.inputs;
  out.mesh = plant_mesh(plant, {options.tolerance_m});
  out.mtg = plant_mtg(plant, out.mesh);
  out.organ_of_vertex = organs_by_label(out.mesh, out.mtg);
}

void read_mtg_plant(const std::string& path, const PlantFileOptions& options, PlantFile& out) {
  out.mtg = read_mtg(path);
  out.notes = out.mtg.notes;
  const bool places = out.mtg.feature("XX") && out.mtg.feature("YY") && out.mtg.feature("ZZ");
  if (options.topology_alone && !places && !out.mtg.feature("Length")) {
    out.notes.push_back(path + ": no columns XX YY ZZ or Length: topology alone");
    return;
  }
  MtgGeometryOptions geometry = options.mtg;
  geometry.tolerance_m = options.tolerance_m;
  out.mesh = mtg_mesh(out.mtg, geometry, out.notes, &out.organ_of_vertex);
}

void read_opf_plant(const std::string& path, const PlantFileOptions& options, PlantFile& out) {
  OpfPlant plant = read_opf(path, options.opf);
  out.mesh = std::move(plant.mesh);
  out.mtg = std::move(plant.mtg);
  out.organ_of_vertex = std::move(plant.organ_of_vertex);
  out.notes = std::move(plant.notes);
}

void draw_string(const PlantFileOptions& options, PlantFile& out) {
  TurtlePlant plant = turtle(*out.derived, options.tolerance_m);
  if (plant.mesh.triangles.empty()) bad_input({out.derived->file}, "the turtle draws nothing");
  out.mesh = std::move(plant.mesh);
  out.mtg = std::move(plant.mtg);
  out.organ_of_vertex = std::move(plant.organ_of_vertex);
  out.notes = out.derived->notes;
}

void read_lsystem_plant(const std::string& path, const PlantFileOptions& options, PlantFile& out) {
  out.derived = derive(read_lsystem(path), options.steps);
  draw_string(options, out);
}

void read_lstring_plant(const std::string& path, const PlantFileOptions& options, PlantFile& out) {
  out.derived = read_lstring(path);
  draw_string(options, out);
}

struct PlantKind {
  std::string_view extension;
  void (*read)(const std::string& path, const PlantFileOptions& options, PlantFile& out);
};
constexpr PlantKind plant_kinds[] = {{".bpms", read_bpms_plant},
                                     {".mtg", read_mtg_plant},
                                     {".opf", read_opf_plant},
                                     {".lsys", read_lsystem_plant},
                                     {".lstr", read_lstring_plant}};

}  // namespace

std::vector<std::string> plant_file_extensions() {
  std::vector<std::string> out;
  for (const PlantKind& kind : plant_kinds) out.emplace_back(kind.extension);
  return out;
}

bool is_plant_file(const std::string& path) {
  const std::string extension = plant_extension(path);
  return std::any_of(std::begin(plant_kinds), std::end(plant_kinds),
                     [&](const PlantKind& kind) { return kind.extension == extension; });
}

PlantFile read_plant_file(const std::string& path, const PlantFileOptions& options) {
  const std::string extension = plant_extension(path);
  for (const PlantKind& kind : plant_kinds) {
    if (kind.extension != extension) continue;
    PlantFile out;
    out.name = std::filesystem::path(path).stem().string();
    out.inputs = {path};
    kind.read(path, options, out);
    return out;
  }
  bad_input({path}, "unknown kind of plant file {}{}", in_quotes(extension),
            did_you_mean(extension, plant_file_extensions()));
}

std::vector<std::string> plant_file_paths(const std::string& path) {
  const std::string extension = plant_extension(path);
  if (extension == ".mtg" || extension == ".opf" || extension == ".lstr") return {path};
  return mesh_file_paths(path);
}

std::vector<MeshFile> plant_files(const std::string& path, const PlantFile& plant) {
  const std::string extension = plant_extension(path);
  if (extension == ".mtg") return {{path, mtg_text(plant.mtg)}};
  if (extension == ".opf") return {{path, opf_text(plant.mesh, plant.mtg, plant.organ_of_vertex)}};
  if (extension == ".lstr") {
    if (!plant.derived) bad_input({path}, "a derived string comes of an L-system (.lsys, .lstr) alone");
    return {{path, lstring_text(*plant.derived)}};
  }
  return mesh_files(path, plant.mesh);
}

}  // namespace bpms
