#include "core/units.h"
#include "simulate/light/light.h"

namespace bpms {

Sky read_isotropic_sky(const TomlValue& table, const LightContext& context) {
  const Bands& bands = context.bands;
  Sky out;
  const TomlValue radiance = table.get("radiance");
  const TomlValue irradiance = table.get("irradiance");
  if (static_cast<bool>(radiance) == static_cast<bool>(irradiance))
    table.reject_choice("expected one of radiance and irradiance (on the horizontal, or \"brf\")");
  if (radiance) {
    out.radiance = read_spectrum(radiance, bands, 0.0, brightest, context.inputs);
  } else if (irradiance.is_string() && irradiance.string() == "brf") {
    out.radiance.assign(bands.count(), 1.0);
  } else {
    out.radiance = read_spectrum(irradiance, bands, 0.0, brightest, context.inputs);
    for (double& value : out.radiance) value /= pi;
  }
  return out;
}

}  // namespace bpms
