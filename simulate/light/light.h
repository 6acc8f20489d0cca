// Where light comes from: a sun (a direction) and a sky, kept apart in all results as origin direct and
// diffuse. Directions point from the target to the source. Units: irradiance W m-2 um-1, radiance W m-2 sr-1
// um-1, or any other as long as it is the same throughout; "brf" makes the reflected radiance the reflectance
// factor. To add a sky: its own file with a reader and a line in the table of read_light.cpp.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "scene/scene.h"
#include "simulate/materials/spectrum.h"

namespace bpms {

struct Sun {
  double zenith_deg = 0;
  double azimuth_deg = 0;  // as the file wrote it
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  std::vector<double> irradiance;  // on the plane normal to the sun, per band
};

struct Sky {
  std::vector<double> radiance;  // isotropic, per band
};

struct Light {
  std::optional<Sun> sun;
  std::optional<Sky> sky;
  // On a horizontal plane, per band; zero where there is none.
  std::vector<double> direct_irradiance(std::size_t bands) const;
  std::vector<double> diffuse_irradiance(std::size_t bands) const;
};

Sun read_sun(const TomlValue& table, const Domain& domain, const Bands& bands,
             std::vector<std::string>& inputs);
Sky read_isotropic_sky(const TomlValue& table, const Bands& bands, std::vector<std::string>& inputs);
Light read_light(const TomlValue& table, const Domain& domain, const Bands& bands,
                 std::vector<std::string>& inputs);

inline constexpr double brightest = 1e12;  // refused above: surely a unit gone wrong

}  // namespace bpms
