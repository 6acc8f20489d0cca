#include <cmath>

#include "core/units.h"
#include "simulate/light/light.h"

namespace bpms {

Sun read_sun(const TomlValue& table, const LightContext& context) {
  Sun out;
  for (const char* key : {"name", "azimuth_deg", "irradiance"}) table.get(key);
  out.name = table.string_or("name", "sun");
  if (out.name.empty()) table.get("name").reject("expected a name");
  const TomlValue zenith = table.get("zenith_deg");
  if (!zenith) table.reject_choice("missing key 'zenith_deg'");
  out.zenith_deg = zenith.number();
  if (!(out.zenith_deg >= 0.0 && out.zenith_deg < 90.0))
    zenith.reject(fmt::format("sun.zenith_deg is {}: expected 0 <= zenith < 90, a sun above the horizon",
                              out.zenith_deg));
  out.azimuth_deg = table.require("azimuth_deg").number(-360.0, 360.0);
  out.direction = direction_from_angles(radians(out.zenith_deg), radians(out.azimuth_deg), context.domain);
  const TomlValue irradiance = table.require("irradiance");
  if (irradiance.is_string() && irradiance.string() == "brf")
    out.irradiance.assign(context.bands.count(), pi / std::cos(radians(out.zenith_deg)));
  else
    out.irradiance = read_spectrum(irradiance, context.bands, 0.0, brightest, context.inputs);
  return out;
}

}  // namespace bpms
