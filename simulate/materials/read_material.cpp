#include <map>

#include "simulate/materials/material.h"

namespace bpms {
namespace {
const std::map<std::string, MaterialReader> material_kinds{
    {"lambertian", read_lambertian},
    {"bilambertian", read_bilambertian},
};
}  // namespace

Material read_material(const TomlValue& table, const std::string& name, const Bands& bands,
                       std::vector<std::string>& inputs) {
  std::vector<std::string> names;
  for (const auto& kind : material_kinds) names.push_back(kind.first);
  const std::string type = table.require("type").one_of(names);
  Material out = material_kinds.at(type)(table, bands, inputs);
  out.name = name;
  out.type = type;
  require_energy(out, table, bands);
  return out;
}

void require_energy(const Material& material, const TomlValue& table, const Bands& bands) {
  constexpr double rounding = 1e-9;  // 0.3 + 0.7 and its like
  for (const auto& reflectance : material.reflectance) {
    for (std::size_t band = 0; band < bands.count(); ++band) {
      const double sum = reflectance[band] + material.transmittance[band];
      if (sum > 1.0 + rounding)
        table.require("reflectance")
            .reject(fmt::format("reflectance {} + transmittance {} = {} in {}: expected a sum of at most 1",
                                reflectance[band], material.transmittance[band], sum, bands.name(band)));
    }
  }
}

}  // namespace bpms
