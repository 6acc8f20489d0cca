#include "scene/importers/scene_notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "scene/importers/mesh_file.h"
#include "scene/intersect/box.h"

namespace bpms {
namespace {

constexpr double largest_leaf_m = 10, smallest_leaf_m = 1e-5, scales_apart = 1e6;

struct ScaleRange {
  double least = std::numeric_limits<double>::infinity(), most = 0;
};

double width(const Box& box) {
  return box.empty() ? 0 : (box.high - box.low).maxCoeff();
}

// The narrowest and the widest of a prototype's leaves.
ScaleRange leaf_sizes(const Prototype& prototype, const std::vector<std::string>& materials) {
  ScaleRange out;
  const auto add = [&](double size) {
    out.least = std::min(out.least, size), out.most = std::max(out.most, size);
  };
  for (std::size_t k = 0; k < prototype.discs.size(); ++k) {
    const std::uint32_t material =
        prototype.material_of_disc.empty() ? prototype.disc_material : prototype.material_of_disc[k];
    if (names_a_leaf(materials[material])) add(2 * static_cast<double>(prototype.discs[k].radius_m));
  }
  if (!prototype.mesh) return out;
  const Mesh& mesh = *prototype.mesh;
  std::vector<Box> organs(mesh.organs.size());
  for (std::size_t k = 0; k < mesh.organ_of_triangle.size(); ++k)
    for (const std::uint32_t v : mesh.triangles[k])
      organs[mesh.organ_of_triangle[k]].include(mesh.positions_m[v].cast<double>());
  for (std::size_t k = 0; k < organs.size(); ++k)
    if (mesh.organs[k].kind == "leaf" && !organs[k].empty()) add(width(organs[k]));
  return out;
}

}  // namespace

void note_implausible(Scene& scene) {
  std::vector<ScaleRange> scales(scene.prototypes.size());
  for (const Instance& i : scene.instances) {
    ScaleRange& range = scales[i.prototype];
    range.least = std::min(range.least, i.scale), range.most = std::max(range.most, i.scale);
  }
  const double domain = scene.domain.size_m.maxCoeff();
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  const Prototype *small = nullptr, *large = nullptr;
  for (std::size_t p = 0; p < scene.prototypes.size(); ++p) {
    const Prototype& prototype = scene.prototypes[p];
    if (!(scales[p].most > 0)) continue;
    const double size = width(bounds(prototype));
    const double least = scales[p].least * size, most = scales[p].most * size;
    if (domain > scales_apart * least)
      scene.notes.push_back(
          fmt::format("prototype {} stands {:.3g} m wide in a domain of {:.3g} m, a million times as wide: "
                      "check its unit",
                      in_quotes(prototype.name), least, domain));
    if (least < smallest) smallest = least, small = &prototype;
    if (most > largest) largest = most, large = &prototype;
    const ScaleRange leaves = leaf_sizes(prototype, scene.materials);
    if (leaves.most * scales[p].most > largest_leaf_m)
      scene.notes.push_back(fmt::format("prototype {} has a leaf of {:.3g} m: check its unit",
                                        in_quotes(prototype.name), leaves.most * scales[p].most));
    if (leaves.least * scales[p].least < smallest_leaf_m)
      scene.notes.push_back(fmt::format("prototype {} has a leaf of {:.3g} m: check its unit",
                                        in_quotes(prototype.name), leaves.least * scales[p].least));
  }
  if (small != nullptr && large != nullptr && largest > scales_apart * smallest)
    scene.notes.push_back(
        fmt::format("prototype {} is {:.3g} m wide, {} {:.3g} m, a million times as much: check their units",
                    in_quotes(small->name), smallest, in_quotes(large->name), largest));
}

}  // namespace bpms
