// View directions as sensors write them: views = [[vza, vaa], ...], or plane = "principal" | "cross" with
// vza_deg = a list, or a set over the hemisphere, hemisphere = { zeniths = N, azimuths = M, most_deg = 75 }:
// nadir, then N rings at equal steps up to most_deg with M azimuths each, the first at 0.
#pragma once
#include "simulate/sensors/sensor.h"

namespace bpms {

struct ViewAngles {
  double vza_deg, vaa_deg;
};
inline constexpr double steepest_deg =
    89.0;  // beyond, a ray crosses a periodic domain more often than makes sense

std::vector<ViewAngles> read_view_list(const TomlValue& table, const SensorContext& context);

}  // namespace bpms
