// [materials] read from a piece of scene.toml.
#pragma once
#include <gmock/gmock.h>

#include "core/units.h"
#include "simulate/materials/energy.h"
#include "tests/data.h"

namespace bpms::test {

struct Materials {
  Bands bands;
  std::vector<std::string> inputs;
  std::map<std::string, Material> by_name;
  const Material& operator[](const std::string& name) const { return by_name.at(name); }
};

// `text` holds [materials.X] tables; files are relative to the folder. Unknown keys are refused.
Materials materials_of(const TemporaryFolder& folder, const std::string& text,
                       const std::vector<double>& wavelengths_nm);

// The one material "x" of this body.
Material material_of(const std::string& body, const std::vector<double>& wavelengths_nm = {650});
Material material_of(const TemporaryFolder& folder, const std::string& body,
                     const std::vector<double>& wavelengths_nm = {650});

inline Eigen::Vector3f direction(double zenith_deg, double azimuth_deg) {
  const double z = radians(zenith_deg), a = radians(azimuth_deg);
  return Eigen::Vector3d(std::sin(z) * std::cos(a), std::sin(z) * std::sin(a), std::cos(z)).cast<float>();
}

// The lobe's value in every band.
std::vector<double> values_of(const SurfaceLobe& lobe, const Eigen::Vector3f& view,
                              const Eigen::Vector3f& light, std::size_t bands);

}  // namespace bpms::test
