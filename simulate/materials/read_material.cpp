#include "simulate/materials/energy.h"
#include "simulate/materials/raster_file.h"

namespace bpms {
namespace {

const std::map<std::string, MaterialReader> material_kinds{
    {"lambertian", read_lambertian},
    {"bilambertian", read_bilambertian},
    {"transparent", read_transparent},
    {"srm", read_srm},
    {"waxy_leaf", read_waxy_leaf},
    {"prospect", read_prospect},
    {"rpv", read_rpv},
    {"hapke", read_hapke},
    {"verstraete_pinty_dickinson", read_verstraete_pinty_dickinson},
    {"tabulated", read_tabulated},
    {"mixture", read_mixture},
    {"map", read_map},
};

void read_bump(const TomlValue& table, const MaterialContext& context, Material& material) {
  if (!table) return;
  const TomlValue file = table.require("file");
  material.bump_m = table.require("height_m").number(-1.0, 1.0);
  material.bump = std::make_shared<Raster>(read_heights(context.input_file(file)));
}

}  // namespace

std::string MaterialContext::input_file(const TomlValue& value) const {
  inputs_.push_back(value.file_relative(value.string()));
  return inputs_.back();
}

bool MaterialContext::has(const std::string& name) const {
  return table_ && table_.has(name);
}

const Material& MaterialContext::material(const std::string& name, const TomlValue& asked) {
  if (const auto found = known_.find(name); found != known_.end()) return found->second;
  if (!has(name)) asked.reject(fmt::format("{} names {}: no [materials.{}]", asked.name(), name, name));
  if (!being_read_.insert(name).second)
    asked.reject(fmt::format("{} names {}, which is made of itself", asked.name(), name));
  Material material = read_material(table_.require(name), name, *this);
  being_read_.erase(name);
  return known_[name] = std::move(material);
}

Material read_material(const TomlValue& table, const std::string& name, MaterialContext& context) {
  std::vector<std::string> names;
  for (const auto& kind : material_kinds) names.push_back(kind.first);
  const std::string type = table.require("type").one_of(names);
  Material out = material_kinds.at(type)(table, context);
  out.name = name;
  out.type = type;
  read_bump(table.get("bump"), context, out);
  require_energy(out, table, context.bands());
  return out;
}

Material black_material(const Bands& bands, bool opaque) {
  Material out;
  out.reflectance[0].assign(bands.count(), 0.0);
  out.reflectance[1] = out.transmittance = out.reflectance[0];
  out.opaque = opaque;
  return out;
}

std::array<bool, 2> read_faces(const TomlValue& table) {
  const TomlValue face = table.get("face");
  const std::string which = face ? face.one_of({"both", "front", "back"}) : "both";
  return {which != "back", which != "front"};
}

}  // namespace bpms
