// Opaque surface that reflects by Lambert's law from either face.
#include "simulate/materials/material.h"

namespace bpms {

Material read_lambertian(const TomlValue& table, MaterialContext& context) {
  Material out = black_material(context.bands(), true);
  out.reflectance[0] = context.spectrum(table.require("reflectance"), 0.0, 1.0);
  out.reflectance[1] = out.reflectance[0];
  return out;
}

}  // namespace bpms
