// Optical properties of surfaces, by name, from [materials.X] of scene.toml.
// Every kind here scatters diffusely (Lambert's law on the side it sends light to): reflectance of each face
// and one transmittance, per band, dimensionless, reflectance + transmittance <= 1. To add a kind: its own
// file with a reader, declared below, and a line in the table of read_material.cpp.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "simulate/materials/spectrum.h"

namespace bpms {

struct Material {
  std::string name;
  std::string type;
  std::array<std::vector<double>, 2> reflectance;  // of the upper (front) and the lower (back) face, per band
  std::vector<double> transmittance;
  bool opaque = true;  // nothing passes: lit means lit on the side that is seen
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
