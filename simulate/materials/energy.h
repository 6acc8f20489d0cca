// A surface gives out no more than it receives: reflectance + transmittance + directional albedo of the lobes
// <= 1 in every band, whatever the direction of the light.
#pragma once
#include "simulate/materials/material.h"

namespace bpms {

// The part of the light from `light` (unit, z > 0: the lit face is up) that the lobe sends into all
// directions, per band. By the lobe's own sampling over a regular grid, good to some 1e-4 (1e-3 grazing).
std::vector<double> directional_albedo(const SurfaceLobe& lobe, const Eigen::Vector3f& light,
                                       std::size_t bands);

// Refuses, at `table`, a material that gives out more than it receives, with the band and, for lobes, the
// angle. What empirical lobes do is added to the material's notes instead.
void require_energy(Material& material, const TomlValue& table, const Bands& bands);

}  // namespace bpms
