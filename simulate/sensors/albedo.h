// The albedo camera (paper, section 4.1.3) gathers rays in proportion to the cosine to its
// horizontal face, from one side, over an aperture: the whole cell or a disc. Looking down from the top of a
// canopy the mean over its pixels times pi is the exitance, and over the irradiance the albedo: DHR under a
// sun, BHR under an isotropic sky, blue-sky albedo under both. Looking up it is the irradiance at a level.
// Pixels are equal parts of the cosine-weighted hemisphere: rows from the axis outwards, columns by azimuth.
#pragma once
#include <limits>

#include "simulate/sensors/placement.h"

namespace bpms {

class AlbedoSensor : public Sensor {
 public:
  bool down = true;
  std::optional<double> height_m;             // of the whole cell; none: above all of the scene
  std::optional<Eigen::Vector3d> location_m;  // of a disc instead
  double radius_m = 0;
  PixelGrid sectors{1, 1};  // azimuths, zeniths
  Domain domain;

  std::size_t views() const override { return sectors.pixels(); }
  Ray start(std::size_t view, const SensorNumbers& random, const Extent& extent) const override;
  bool uses_aperture() const override { return true; }
  Measures measures() const override { return Measures::irradiance; }
  std::optional<Eigen::Vector3d> faces(std::size_t) const override {
    return Eigen::Vector3d(0, 0, down ? -1 : 1);
  }
  double vza_deg(std::size_t) const override { return std::numeric_limits<double>::quiet_NaN(); }
  double vaa_deg(std::size_t) const override { return std::numeric_limits<double>::quiet_NaN(); }
  int width() const override { return sectors.pixels() > 1 ? sectors.columns : 0; }
  int height() const override { return sectors.pixels() > 1 ? sectors.rows : 0; }

 private:
  Eigen::Vector3d aperture(const SensorNumbers& random, const Extent& extent) const;
};

}  // namespace bpms
