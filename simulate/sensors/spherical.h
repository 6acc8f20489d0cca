// A hemispherical imaging surface about `location`, the centre of a sphere; `direction` is its axis.
//   in (as ARARAT): rays start on the hemisphere of `radius_m` behind the axis and run to the centre and on.
//     A pixel lies where its point of the surface lies, seen along the axis: looking down with north up, the
//     image is a map of the view directions.
//   out: rays start at the centre and spread about the axis, as in a fisheye lens of 180 degrees.
// The angle to the axis grows in proportion to the distance from the middle of the image (equal angle), or
// its pixels have equal solid angles (equal area). The image is the inscribed circle: a pixel whose centre
// lies outside is not part of it. Of a pixel on the rim, what lies outside is mirrored inwards.
#pragma once
#include "simulate/sensors/placement.h"

namespace bpms {

enum class SphereLooking { in, out };
enum class SphereProjection { equal_angle, equal_area };

class SphericalSensor : public Sensor {
 public:
  SensorPose camera;
  Domain domain;
  int side = 1;  // pixels
  double radius_m = 1;
  SphereLooking hemisphere = SphereLooking::in;
  SphereProjection projection = SphereProjection::equal_angle;

  // From the centre to the point of the surface (in) or of the scene (out) that is seen there; pixel centres
  // are integers.
  Eigen::Vector3d outwards(double column, double row) const;

  std::size_t views() const override {
    return static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  }
  Ray start(std::size_t view, const SensorNumbers& random, const Extent&) const override;
  bool covers(std::size_t view) const override;
  double vza_deg(std::size_t view) const override { return angles(view).zenith_deg; }
  double vaa_deg(std::size_t view) const override { return angles(view).azimuth_deg; }
  int width() const override { return side; }
  int height() const override { return side; }

 private:
  Angles angles(std::size_t view) const;  // towards the sensor, of the pixel's centre; NaN outside
  Eigen::Vector2d in_circle(double column, double row) const;
};

}  // namespace bpms
