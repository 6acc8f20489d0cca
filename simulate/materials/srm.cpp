// The standard reflectance material of the Botanical Plant Modelling System (Lewis 1999): Lambertian
// reflectance and transmittance, a perfect mirror and straight transmittance, all spectral.
#include "simulate/materials/delta_lobes.h"
#include "simulate/materials/material.h"

namespace bpms {

Material read_srm(const TomlValue& table, MaterialContext& context) {
  Material out = black_material(context.bands(), false);
  const auto part = [&](const char* key) {
    const TomlValue value = table.get(key);
    return value ? context.spectrum(value, 0.0, 1.0) : std::vector<double>(context.bands().count(), 0.0);
  };
  const auto any = [](const std::vector<double>& spectrum) {
    for (const double value : spectrum)
      if (value > 0) return true;
    return false;
  };
  out.reflectance[0] = part("reflectance");
  out.reflectance[1] = out.reflectance[0];
  out.transmittance = part("transmittance");
  const std::vector<double> mirror = part("specular_reflectance"), straight = part("specular_transmittance");
  if (any(mirror)) out.lobes.push_back({std::make_shared<Mirror>(), mirror});
  if (any(straight)) out.lobes.push_back({std::make_shared<Straight>(), straight});
  out.opaque = !any(out.transmittance) && !any(straight);
  return out;
}

}  // namespace bpms
