// Opaque surface that reflects by Lambert's law from either face.
#include "simulate/materials/material.h"

namespace bpms {

Material read_lambertian(const TomlValue& table, const Bands& bands, std::vector<std::string>& inputs) {
  Material out;
  out.reflectance[0] = read_spectrum(table.require("reflectance"), bands, 0.0, 1.0, inputs);
  out.reflectance[1] = out.reflectance[0];
  out.transmittance.assign(bands.count(), 0.0);
  out.opaque = true;
  return out;
}

}  // namespace bpms
