#include "simulate/output/quantity.h"

#include "core/units.h"

namespace bpms {

const char* reflectance_name(const Light& light) {
  return light.sky ? "hdrf" : "brf";
}

std::vector<double> reflectance_scale(const Light& light, Origin origin, std::size_t bands) {
  const std::vector<double> direct = light.direct_irradiance(bands),
                            diffuse = light.diffuse_irradiance(bands);
  std::vector<double> out(bands);
  for (std::size_t band = 0; band < bands; ++band) {
    const double irradiance =
        (origin != Origin::diffuse ? direct[band] : 0.0) + (origin != Origin::direct ? diffuse[band] : 0.0);
    out[band] = irradiance > 0 ? pi / irradiance : no_value;
  }
  return out;
}

std::vector<std::size_t> parts_with(const SensorResult& result, Origin origin, Component component,
                                    bool by_order) {
  std::vector<std::size_t> out;
  for (std::size_t p = 0; p < result.parts.size(); ++p) {
    const Part& part = result.parts[p];
    if (part.origin == origin && part.component == component && (part.order != every_order) == by_order)
      out.push_back(p);
  }
  return out;
}

}  // namespace bpms
