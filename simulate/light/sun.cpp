#include <cmath>

#include "core/units.h"
#include "simulate/light/curve.h"
#include "simulate/light/light.h"

namespace bpms {

Sun read_sun(const TomlValue& table, const LightContext& context) {
  Sun out;
  for (const char* key : {"name", "azimuth_deg", "irradiance", "radius_deg"}) table.get(key);
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
  if (const TomlValue radius = table.get("radius_deg")) {
    constexpr double widest_deg = 10;  // the sun has 0.2666; lamps may be wider
    const double radius_deg = radius.number(0, widest_deg);
    if (!(out.zenith_deg + radius_deg < 90))
      radius.reject("the disc reaches below the horizon: expected zenith_deg + radius_deg < 90");
    out.radius = radians(radius_deg);
  }
  const TomlValue irradiance = table.require("irradiance");
  if (irradiance.is_string() && irradiance.string() == "brf")
    out.irradiance.assign(context.bands.count(), pi / std::cos(radians(out.zenith_deg)));
  else if (irradiance.is_string() && irradiance.string() == "zibordi_voss")
    out.model = "zibordi_voss";
  else
    out.irradiance = read_source_spectrum(irradiance, context.bands, context.inputs);
  return out;
}

}  // namespace bpms
