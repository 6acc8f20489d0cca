// A planar camera whose lines of sight are all parallel: an image plane of a width and a height in metres,
// centred at `location`.
#pragma once
#include "simulate/sensors/placement.h"

namespace bpms {

class OrthographicSensor : public Sensor {
 public:
  SensorPose camera;
  PixelGrid size;
  double width_m = 1, height_m = 1;
  double zenith_deg = 0, azimuth_deg = 0;  // towards the sensor
  bool above = false;                      // no point of the image plane is within the scene

  // A point of the image plane; pixel centres are integers.
  Eigen::Vector3d point(double column, double row) const;
  double lowest_m() const;  // of the image plane

  std::size_t views() const override { return size.pixels(); }
  Ray start(std::size_t view, const SensorNumbers& random, const Extent&) const override;
  std::optional<Eigen::Vector3d> parallel(std::size_t) const override;
  double vza_deg(std::size_t) const override { return zenith_deg; }
  double vaa_deg(std::size_t) const override { return azimuth_deg; }
  int width() const override { return size.columns; }
  int height() const override { return size.rows; }
};

}  // namespace bpms
