// Where light comes from: suns (directions, or discs of a finite size) and a sky, kept apart in all results
// as origin direct and diffuse. Directions point from the target to the source. Units: irradiance W m-2 um-1,
// radiance W m-2 sr-1 um-1, per traced band. To add a kind of sky: its own file with a reader and a line in
// the table of read_light.cpp.
#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "simulate/light/sky_map.h"
#include "simulate/materials/spectrum.h"

namespace bpms {

struct Sun {
  std::string name = "sun";
  double zenith_deg = 0;
  double azimuth_deg = 0;  // as the file wrote it
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  double radius = 0;               // angular, of a disc of even radiance, in radians; 0: a direction
  std::vector<double> irradiance;  // on the plane normal to the sun's centre, per band
};

struct Sky {
  // Irradiance on the horizontal over pi, per band: the radiance itself where it is isotropic.
  std::vector<double> radiance;
  std::shared_ptr<const SkyMap> map;  // null: isotropic
};

struct Light {
  std::vector<Sun> suns;
  std::optional<Sky> sky;
  // On a horizontal plane, per band; zero where there is none. Of one sun or of all together.
  std::vector<double> direct_irradiance(std::size_t bands, int sun = -1) const;
  std::vector<double> diffuse_irradiance(std::size_t bands) const;
};

struct LightContext {
  const Domain& domain;
  const Bands& bands;
  std::vector<std::string>& inputs;
  std::vector<std::string>& notes;
  const std::vector<Sun>& suns;  // those read before the sky
};
Sun read_sun(const TomlValue& table, const LightContext& context);
Sky read_isotropic_sky(const TomlValue& table, const LightContext& context);
Light read_light(const TomlValue& table, const Domain& domain, const Bands& bands,
                 std::vector<std::string>& inputs, std::vector<std::string>& notes);

inline constexpr double brightest = 1e12;  // refused above: surely a unit gone wrong

}  // namespace bpms
