// A leaf (Ross 1981): reflects and transmits diffusely. The lower face may reflect differently; the
// transmittance is one, since two would break reciprocity.
#include "simulate/materials/material.h"

namespace bpms {

Material read_bilambertian(const TomlValue& table, MaterialContext& context) {
  Material out = black_material(context.bands(), false);
  const TomlValue back = table.get("reflectance_back");
  out.reflectance[0] = context.spectrum(table.require("reflectance"), 0.0, 1.0);
  out.reflectance[1] = back ? context.spectrum(back, 0.0, 1.0) : out.reflectance[0];
  out.transmittance = context.spectrum(table.require("transmittance"), 0.0, 1.0);
  return out;
}

}  // namespace bpms
