// The quantities that results are written as. Reflectance factors are radiance times pi over the horizontal
// irradiance of their origin: brf under the sun, hdrf as soon as there is a sky (total: over the whole
// irradiance; direct, diffuse: over the part's own). What a receiver of irradiance gets over that irradiance
// is, above the canopy and looking down, its albedo: dhr under suns, bhr under the sky, albedo under both;
// looking up, transmittance.
#pragma once
#include <limits>

#include "simulate/simulate.h"

namespace bpms {

inline constexpr double no_value =
    std::numeric_limits<double>::quiet_NaN();  // where a quantity does not apply

struct Quantity {
  const char* name;
  const char* words;
  const char* units;
};
Quantity reflectance_quantity(const Light& light, const Sensor& sensor);
// Its name with "_recombined", at a diffuse fraction that was asked for.
std::string recombined_name(const Light& light, const Sensor& sensor);
// "radiance" or "irradiance", and what the mean radiance of a view is multiplied by.
Quantity light_quantity(const Sensor& sensor);
double light_scale(const Sensor& sensor);

// pi / E of this origin in each written band (of one sun alone, where one is named); NaN where E is 0.
std::vector<double> reflectance_scale(const Simulation& simulation, Origin origin, int sun = every_sun);

// The sun whose angles belong to a part: the only one, or the part's own; null where there is none such.
const Sun* sun_of(const Light& light, const Part& part = {});

// Which parts of a result hold this, in their order; of every sun together.
std::vector<std::size_t> parts_with(const SensorResult& result, Origin origin, Component component,
                                    bool by_order);

}  // namespace bpms
