#include <map>

#include "core/units.h"
#include "simulate/light/light.h"

namespace bpms {
namespace {
using SkyReader = Sky (*)(const TomlValue&, const LightContext&);
const std::map<std::string, SkyReader> skies{
    {"isotropic", read_isotropic_sky},
};

// One table, or an array of them whose names differ.
std::vector<Sun> read_suns(const TomlValue& value, const LightContext& context) {
  std::vector<Sun> out;
  if (!value.is_array()) {
    out.push_back(read_sun(value, context));
    return out;
  }
  if (value.size() == 0) value.reject("expected at least one sun");
  for (std::size_t i = 0; i < value.size(); ++i) {
    Sun sun = read_sun(value[i], context);
    if (!value[i].has("name")) sun.name += std::to_string(i + 1);
    for (const Sun& other : out)
      if (other.name == sun.name) value[i].reject("a second sun named \"" + sun.name + "\"");
    out.push_back(std::move(sun));
  }
  return out;
}
}  // namespace

Light read_light(const TomlValue& table, const Domain& domain, const Bands& bands,
                 std::vector<std::string>& inputs, std::vector<std::string>& notes) {
  Light out;
  const LightContext context{domain, bands, inputs, notes, out.suns};
  if (const TomlValue sun = table.get("sun")) out.suns = read_suns(sun, context);
  if (const TomlValue sky = table.get("sky")) {
    std::vector<std::string> names;
    for (const auto& kind : skies) names.push_back(kind.first);
    out.sky = skies.at(sky.require("type").one_of(names))(sky, context);
  }
  if (out.suns.empty() && !out.sky) table.reject("no light: expected a sun, a sky or both");
  return out;
}

std::vector<double> Light::direct_irradiance(std::size_t bands, int sun) const {
  std::vector<double> out(bands, 0.0);
  for (std::size_t s = 0; s < suns.size(); ++s) {
    if (sun >= 0 && static_cast<std::size_t>(sun) != s) continue;
    for (std::size_t b = 0; b < bands; ++b) out[b] += suns[s].irradiance[b] * suns[s].direction.z();
  }
  return out;
}

std::vector<double> Light::diffuse_irradiance(std::size_t bands) const {
  std::vector<double> out(bands, 0.0);
  if (sky)
    for (std::size_t b = 0; b < bands; ++b) out[b] = pi * sky->radiance[b];
  return out;
}

}  // namespace bpms
