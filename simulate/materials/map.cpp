// Materials by place: each (U,V) of a surface is of the material that a raster's integer names there. A
// cut-out is a place that is `transparent`.
#include <limits>

#include "core/text.h"
#include "simulate/materials/material.h"
#include "simulate/materials/raster_file.h"

namespace bpms {
namespace {

constexpr int no_material = -1;

struct MapLegend {
  std::vector<std::string> names;
  std::vector<int> of_value = std::vector<int>(most_raster_value + 1, no_material);
};

MapLegend read_legend(const TomlValue& materials, MaterialContext& context) {
  MapLegend out;
  const auto add = [&](int value, const TomlValue& given) {
    const std::string name = given.string();
    const Material& part = context.material(name, given);
    if (part.map || part.bump)
      given.reject(fmt::format("{} is a {}: expected materials without maps and bumps", name,
                               part.map ? "map" : "material with a bump (give the bump to the map)"));
    std::size_t index = 0;
    while (index < out.names.size() && out.names[index] != name) ++index;
    if (index == out.names.size()) out.names.push_back(name);
    out.of_value[static_cast<std::size_t>(value)] = static_cast<int>(index);
  };
  if (materials.is_array()) {
    if (materials.size() > most_raster_value) materials.reject("expected at most 65535 names");
    for (std::size_t i = 0; i < materials.size(); ++i) add(static_cast<int>(i), materials[i]);
  } else if (materials.is_table()) {
    for (const std::string& key : materials.keys()) {
      const TomlValue given = materials.require(key);
      const auto value = parse_integer(key);
      if (!value || *value < 0 || *value > most_raster_value)
        given.reject(fmt::format("{} names no value of the raster: expected an integer from 0 to {}",
                                 in_quotes(key), most_raster_value));
      add(static_cast<int>(*value), given);
    }
  } else {
    materials.reject("expected names [\"lamina\", \"vein\"], or { 0 = \"lamina\", 255 = \"vein\" }");
  }
  if (out.names.empty()) materials.reject("expected at least one material");
  return out;
}

}  // namespace

Material read_map(const TomlValue& table, MaterialContext& context) {
  Material out = black_material(context.bands(), true);
  const MapLegend legend = read_legend(table.require("materials"), context);
  const std::string path = context.input_file(table.require("file"));
  const Raster raster = read_integers(path);
  std::vector<float> indices;
  indices.reserve(raster.values().size());
  for (const float value : raster.values()) {
    const int index = legend.of_value[static_cast<std::size_t>(value)];
    if (index == no_material)
      table.require("file").reject(
          fmt::format("{}: pixel {} of row {} is {}, which `materials` does not name", path,
                      indices.size() % raster.columns() + 1, indices.size() / raster.columns() + 1, value));
    indices.push_back(static_cast<float>(index));
  }
  out.map = std::make_shared<Raster>(raster.columns(), raster.rows(), std::move(indices));
  out.map_materials = legend.names;
  out.opaque = true;
  for (const std::string& name : legend.names)
    out.opaque = out.opaque && context.material(name, table).opaque;
  return out;
}

}  // namespace bpms
