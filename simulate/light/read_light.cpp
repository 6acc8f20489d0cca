#include <map>

#include "core/units.h"
#include "simulate/light/light.h"

namespace bpms {
namespace {
using SkyReader = Sky (*)(const TomlValue&, const Bands&, std::vector<std::string>&);
const std::map<std::string, SkyReader> skies{
    {"isotropic", read_isotropic_sky},
};
}  // namespace

Light read_light(const TomlValue& table, const Domain& domain, const Bands& bands,
                 std::vector<std::string>& inputs) {
  Light out;
  const TomlValue sun = table.get("sun");
  if (sun && sun.is_array()) sun.reject("several suns are not built yet: give one table");
  if (sun) out.sun = read_sun(sun, domain, bands, inputs);
  if (const TomlValue sky = table.get("sky")) {
    std::vector<std::string> names;
    for (const auto& kind : skies) names.push_back(kind.first);
    out.sky = skies.at(sky.require("type").one_of(names))(sky, bands, inputs);
  }
  if (!out.sun && !out.sky) table.reject("no light: expected a sun, a sky or both");
  return out;
}

std::vector<double> Light::direct_irradiance(std::size_t bands) const {
  std::vector<double> out(bands, 0.0);
  if (sun)
    for (std::size_t b = 0; b < bands; ++b) out[b] = sun->irradiance[b] * sun->direction.z();
  return out;
}

std::vector<double> Light::diffuse_irradiance(std::size_t bands) const {
  std::vector<double> out(bands, 0.0);
  if (sky)
    for (std::size_t b = 0; b < bands; ++b) out[b] = pi * sky->radiance[b];
  return out;
}

}  // namespace bpms
