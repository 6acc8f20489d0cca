// A leaf (Ross 1981): reflects and transmits diffusely. The lower face may reflect differently; the
// transmittance is one, since two would break reciprocity.
#include "simulate/materials/material.h"

namespace bpms {

Material read_bilambertian(const TomlValue& table, const Bands& bands, std::vector<std::string>& inputs) {
  Material out;
  const TomlValue back = table.get("reflectance_back");
  out.reflectance[0] = read_spectrum(table.require("reflectance"), bands, 0.0, 1.0, inputs);
  out.reflectance[1] = back ? read_spectrum(back, bands, 0.0, 1.0, inputs) : out.reflectance[0];
  out.transmittance = read_spectrum(table.require("transmittance"), bands, 0.0, 1.0, inputs);
  out.opaque = false;
  return out;
}

}  // namespace bpms
