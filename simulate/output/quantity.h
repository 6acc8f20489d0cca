// The quantities that results are written as. Reflectance factors are radiance times pi over the horizontal
// irradiance of their origin: brf under the sun, hdrf as soon as there is a sky (total: over the whole
// irradiance; direct, diffuse: over the part's own).
#pragma once
#include <limits>

#include "simulate/simulate.h"

namespace bpms {

inline constexpr double no_value =
    std::numeric_limits<double>::quiet_NaN();  // where a quantity does not apply

// "brf" with the sun alone, "hdrf" with a sky.
const char* reflectance_name(const Light& light);

// pi / E of this origin in each band; NaN where E is 0.
std::vector<double> reflectance_scale(const Light& light, Origin origin, std::size_t bands);

// Which parts of a result hold this, in their order.
std::vector<std::size_t> parts_with(const SensorResult& result, Origin origin, Component component,
                                    bool by_order);

}  // namespace bpms
