// A sheet that light passes straight: glass without reflections, a screen seen as its open fraction, the
// holes of a cut-out map.
#include "simulate/materials/delta_lobes.h"
#include "simulate/materials/material.h"

namespace bpms {

Material read_transparent(const TomlValue& table, MaterialContext& context) {
  Material out = black_material(context.bands(), false);
  const TomlValue given = table.get("transmittance");
  std::vector<double> through(context.bands().count(), 1.0);
  if (given) through = context.spectrum(given, 0.0, 1.0);
  out.lobes.push_back({std::make_shared<Straight>(), std::move(through)});
  return out;
}

}  // namespace bpms
