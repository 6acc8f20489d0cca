// Terrain as a table of scene.toml or canopy.toml asks for it: file, centred, offset_m.
#include <cmath>

#include "plant/terrain.h"
#include "plant/terrain/terrain_file.h"

namespace bpms {
namespace {

constexpr double farthest_terrain_m = 1e7;

// A periodic cell repeats: the terrain must be as wide as it is and meet itself without a step.
void check_repeats(const Terrain& terrain, const Eigen::Vector2d& domain_m, const TomlValue& file) {
  const Eigen::Vector2d size = terrain.size_m();
  constexpr double rounding = 1e-6;
  if (((size - domain_m).array().abs() > rounding * domain_m.array()).any())
    file.reject(
        fmt::format("the terrain is {:.9g} x {:.9g} m ({} x {} nodes, {:.9g} m apart), expected the size of "
                    "the periodic domain, {:.9g} x {:.9g} m",
                    size.x(), size.y(), terrain.columns, terrain.rows, terrain.spacing_m.x(), domain_m.x(),
                    domain_m.y()));
  const Eigen::Vector2d off = terrain.low_m + 0.5 * domain_m;
  if ((off.array().abs() > rounding * domain_m.array()).any())
    file.reject(
        fmt::format("the terrain's middle is at ({:.9g}, {:.9g}), expected the origin, where the periodic "
                    "domain's is: give centred = true",
                    off.x(), off.y()));
  constexpr double least_step = 1e-5;  // of the spacing: no more than rounding
  const double step = terrain.edges_differ_by_m();
  if (step > least_step * terrain.spacing_m.minCoeff())
    file.reject(
        fmt::format("opposite edges of the terrain differ by up to {:.6g} m, expected equal heights in a "
                    "periodic domain",
                    step));
}

}  // namespace

std::shared_ptr<const Terrain> read_terrain(const TomlValue& table, const Eigen::Vector2d* periodic_m,
                                            std::vector<std::string>& inputs) {
  const TomlValue file = table.require("file");
  inputs.push_back(file.file_relative(file.string()));
  Terrain terrain = read_terrain_file(inputs.back());
  if (table.boolean_or("centred", false)) terrain.low_m = -0.5 * terrain.size_m();
  if (const TomlValue offset = table.get("offset_m")) {
    const std::vector<double> by = offset.numbers(3);
    terrain.low_m += Eigen::Vector2d(by[0], by[1]);
    for (float& height : terrain.heights_m) height += static_cast<float>(by[2]);
  }
  const double farthest =
      std::max(terrain.low_m.cwiseAbs().maxCoeff(), (terrain.low_m + terrain.size_m()).cwiseAbs().maxCoeff());
  if (!(farthest <= farthest_terrain_m))
    file.reject("the terrain lies beyond 1e7 m: give centred = true or offset_m");
  if (periodic_m != nullptr) {
    check_repeats(terrain, *periodic_m, file);
    terrain.low_m = -0.5 * *periodic_m;
  }
  make_terrain_mesh(terrain, periodic_m != nullptr);
  return std::make_shared<const Terrain>(std::move(terrain));
}

}  // namespace bpms
