#include "simulate/output/quantity.h"

#include "core/units.h"

namespace bpms {

Quantity reflectance_quantity(const Light& light, const Sensor& sensor) {
  if (sensor.measures() == Measures::irradiance) {
    const auto faces = sensor.faces(0);
    if (faces && faces->z() > 0) return {"transmittance", "irradiance over that above the canopy", "1"};
    if (!light.sky) return {"dhr", "directional-hemispherical reflectance", "1"};
    if (light.suns.empty()) return {"bhr", "bihemispherical reflectance", "1"};
    return {"albedo", "albedo under sun and sky", "1"};
  }
  if (light.sky) return {"hdrf", "hemispherical-directional reflectance factor", "1"};
  return {"brf", "bidirectional reflectance factor", "1"};
}

std::string recombined_name(const Light& light, const Sensor& sensor) {
  return std::string(reflectance_quantity(light, sensor).name) + "_recombined";
}

Quantity light_quantity(const Sensor& sensor) {
  if (sensor.measures() == Measures::irradiance)
    return {"irradiance", "spectral irradiance of the sensor", "W m-2 um-1"};
  return {"radiance", "spectral radiance towards the sensor", "W m-2 sr-1 um-1"};
}

double light_scale(const Sensor& sensor) {
  return sensor.measures() == Measures::irradiance ? pi : 1.0;
}

std::vector<double> reflectance_scale(const Simulation& simulation, Origin origin, int sun) {
  const std::size_t traced = simulation.bands.count();
  const std::vector<double> direct =
      simulation.bands.integrate(simulation.light.direct_irradiance(traced, sun));
  const std::vector<double> diffuse = simulation.bands.integrate(simulation.light.diffuse_irradiance(traced));
  std::vector<double> out(direct.size());
  for (std::size_t band = 0; band < out.size(); ++band) {
    const double irradiance =
        (origin != Origin::diffuse ? direct[band] : 0.0) + (origin != Origin::direct ? diffuse[band] : 0.0);
    out[band] = irradiance > 0 ? pi / irradiance : no_value;
  }
  return out;
}

const Sun* sun_of(const Light& light, const Part& part) {
  if (part.sun >= 0) return &light.suns[static_cast<std::size_t>(part.sun)];
  return light.suns.size() == 1 ? &light.suns.front() : nullptr;
}

std::vector<std::size_t> parts_with(const SensorResult& result, Origin origin, Component component,
                                    bool by_order) {
  std::vector<std::size_t> out;
  for (std::size_t p = 0; p < result.parts.size(); ++p) {
    const Part& part = result.parts[p];
    if (part.origin == origin && part.component == component && (part.order != every_order) == by_order &&
        part.sun == every_sun)
      out.push_back(p);
  }
  return out;
}

}  // namespace bpms
