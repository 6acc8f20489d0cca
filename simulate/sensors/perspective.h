// A central perspective camera (the planar camera of ARARAT). Its perspective centre is a point, or a thin
// lens of a finite aperture: then the rays of a point of the image meet again in the plane of focus. The
// image has no distortion and its principal point in the middle, or the lens of a calibrated camera.
// Pixel centres are integers: pixel (c, r) covers [c - 0.5, c + 0.5] x [r - 0.5, r + 0.5].
#pragma once
#include <limits>

#include "calibrate/rig.h"
#include "simulate/sensors/placement.h"

namespace bpms {

class PerspectiveSensor : public Sensor {
 public:
  SensorPose camera;  // location: the perspective centre
  PixelGrid size;
  double semi_width = 1, semi_height = 1;  // of the image at unit distance; not used with a calibrated lens
  std::optional<Camera> lens;
  double aperture_radius_m = 0;
  double focus_m = 0;  // from the centre along the axis
  double zenith_deg = std::numeric_limits<double>::quiet_NaN();
  double azimuth_deg = std::numeric_limits<double>::quiet_NaN();

  // Through the perspective centre, with a length of 1 along the axis.
  Eigen::Vector3d line_of_sight(double column, double row) const;

  std::size_t views() const override { return size.pixels(); }
  Ray start(std::size_t view, const SensorNumbers& random, const Extent&) const override;
  bool uses_aperture() const override { return aperture_radius_m > 0; }
  double vza_deg(std::size_t) const override { return zenith_deg; }
  double vaa_deg(std::size_t) const override { return azimuth_deg; }
  int width() const override { return size.columns; }
  int height() const override { return size.rows; }
};

// The placement of a calibrated camera in the scene: X_scene = r X_rig + t.
SensorPose placement_in_scene(const Camera& camera, const Eigen::Matrix3d& r_scene_from_rig,
                              const Eigen::Vector3d& t_scene_from_rig_m);

}  // namespace bpms
