#include "scene/importers/ground.h"

#include <cmath>

#include "scene/importers/terrain_file.h"

namespace bpms {
namespace {

constexpr double highest_ground_m = 1e7;

// A periodic cell repeats: the terrain must be as wide as it is and meet itself without a step.
void check_repeats(const Terrain& terrain, const Domain& domain, const TomlValue& file) {
  const Eigen::Vector2d size = terrain.size_m();
  constexpr double rounding = 1e-6;
  if (((size - domain.size_m).array().abs() > rounding * domain.size_m.array()).any())
    file.reject(
        fmt::format("the terrain is {:.9g} x {:.9g} m ({} x {} nodes, {:.9g} m apart), expected the size of "
                    "the periodic domain, {:.9g} x {:.9g} m",
                    size.x(), size.y(), terrain.columns, terrain.rows, terrain.spacing_m, domain.size_m.x(),
                    domain.size_m.y()));
  const Eigen::Vector2d off = terrain.low_m + 0.5 * domain.size_m;
  if ((off.array().abs() > rounding * domain.size_m.array()).any())
    file.reject(
        fmt::format("the terrain's middle is at ({:.9g}, {:.9g}), expected the origin, where the periodic "
                    "domain's is: give centred = true",
                    off.x(), off.y()));
  constexpr double least_step = 1e-5;  // of the spacing: no more than rounding
  const double step = terrain.edges_differ_by_m();
  if (step > least_step * terrain.spacing_m)
    file.reject(
        fmt::format("opposite edges of the terrain differ by up to {:.6g} m, expected equal heights in a "
                    "periodic domain",
                    step));
}

void read_dem(const TomlValue& table, Scene& scene, Ground& out) {
  const TomlValue file = table.require("file");
  scene.inputs.push_back(file.file_relative(file.string()));
  Terrain terrain = read_terrain_file(scene.inputs.back());
  if (table.boolean_or("centred", false)) terrain.low_m = -0.5 * terrain.size_m();
  if (const TomlValue offset = table.get("offset_m")) {
    const std::vector<double> by = offset.numbers(3);
    terrain.low_m += Eigen::Vector2d(by[0], by[1]);
    for (float& height : terrain.heights_m) height += static_cast<float>(by[2]);
  }
  const double farthest =
      std::max(terrain.low_m.cwiseAbs().maxCoeff(), (terrain.low_m + terrain.size_m()).cwiseAbs().maxCoeff());
  if (!(farthest <= highest_ground_m))
    file.reject("the terrain lies beyond 1e7 m: give centred = true or offset_m");
  if (const TomlValue outside = table.get("outside_height_m")) {
    if (scene.domain.periodic) outside.reject("a periodic domain has no outside");
    out.height_m = outside.number(-highest_ground_m, highest_ground_m);
    out.plane_outside = true;
  }
  if (scene.domain.periodic) {
    check_repeats(terrain, scene.domain, file);
    terrain.low_m = -0.5 * scene.domain.size_m;
  }
  make_terrain_mesh(terrain, scene.domain.periodic);
  out.terrain = std::make_shared<const Terrain>(std::move(terrain));
}

}  // namespace

Ground read_ground(const TomlValue& table, MaterialNames& names, Scene& scene) {
  const TomlValue type = table.require("type");
  Ground out;
  if (type.one_of({"plane", "dem"}) == "dem") {
    read_dem(table, scene, out);
  } else if (const TomlValue height = table.get("height_m")) {
    out.height_m = height.number(-highest_ground_m, highest_ground_m);
  }
  const TomlValue material = table.require("material");
  out.material = names.number(material.string(), material.where());
  return out;
}

}  // namespace bpms
