// What a flux sensor asks for beside the fluxes of the whole scene and of its materials.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "core/toml.h"

namespace bpms {

struct FluxOptions {
  std::vector<double> layers_m{};   // edges of the layers, rising; metres
  int layers = 0;                   // or so many equal ones, from the bottom to the top of the scene
  bool organs = true;               // by organ of each prototype's mesh, all its instances together
  bool plants = false;              // by instance
  std::array<int, 2> map_px{0, 0};  // of the ground's irradiance: columns (x), rows (from the north); 0: none
};
FluxOptions read_flux_options(const TomlValue& table);

// A [[sensors]] table of type "flux".
struct FluxSensor {
  std::string name;
  FluxOptions options;
};

}  // namespace bpms
