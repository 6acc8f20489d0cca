// Optical properties of surfaces, by name, from [materials.X] of scene.toml: a diffuse part (Lambert's law on
// the side it sends light to: reflectance of each face and one transmittance, per traced band, dimensionless,
// reflectance + transmittance <= 1) and lobes beside it. To add a kind: its own file with a reader, declared
// below, and a line in the table of read_material.cpp.
#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "simulate/materials/lobe.h"
#include "simulate/materials/raster.h"
#include "simulate/materials/spectrum.h"

namespace bpms {

struct SurfaceLobe {
  std::shared_ptr<const Lobe> lobe;
  std::vector<double> spectrum;             // per traced band; empty where the lobe is not separable
  std::array<bool, 2> on_face{true, true};  // seen from the front, from the back
};

struct Material {
  std::string name;
  std::string type;
  std::array<std::vector<double>, 2> reflectance;  // of the upper (front) and the lower (back) face, per band
  std::vector<double> transmittance;
  bool opaque = true;  // nothing passes: lit means lit on the side that is seen
  std::vector<SurfaceLobe> lobes;

  // A material map: each place (U,V) is of another material, by name (these are not maps themselves).
  std::shared_ptr<const Raster> map;
  std::vector<std::string> map_materials;  // by the raster's integers
  // A bump map: heights over (U,V), which tilt the normal; `bump_m` = metres for the raster's full scale.
  std::shared_ptr<const Raster> bump;
  double bump_m = 0;

  bool is_diffuse() const { return lobes.empty() && !map && !bump; }
};

using MaterialReader = Material (*)(const TomlValue& table, const Bands& bands,
                                    std::vector<std::string>& inputs);
Material read_lambertian(const TomlValue& table, const Bands& bands, std::vector<std::string>& inputs);
Material read_bilambertian(const TomlValue& table, const Bands& bands, std::vector<std::string>& inputs);

Material read_material(const TomlValue& table, const std::string& name, const Bands& bands,
                       std::vector<std::string>& inputs);

// Refuses, at `table`, a material that gives out more than it receives; names the band.
void require_energy(const Material& material, const TomlValue& table, const Bands& bands);

}  // namespace bpms
