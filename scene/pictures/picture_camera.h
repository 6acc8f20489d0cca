// Where a picture is seen from, and which ray belongs to a place on it. x right, y down, in pixels.
// Azimuth: of the direction from the plants to the eye, clockwise from north; elevation: above the horizon.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "scene/intersect/intersector.h"
#include "scene/scene.h"

namespace bpms {

struct PictureView {
  std::string name;
  double azimuth_deg = 0, elevation_deg = 0;
};
// front (from the south), back, side (from the east), left (from the west), top (north is up), oblique.
PictureView named_view(const std::string& name);  // bad_input for others
std::vector<std::string> view_names();

// Seen from outside, turned to the view: what is to be framed, along its axes.
struct PictureFrame {
  Eigen::Vector3d right, up, back;  // back: towards the eye
  Eigen::Vector3d low, high;        // extent of the scene along them
};
PictureFrame frame_of(const Scene& scene, const PictureView& view);

struct PictureCamera {
  PictureFrame frame;
  double width = 1, height = 1;  // pixels
  double metres_per_pixel = 0;   // orthographic: everywhere; perspective: in the plane through the middle
  double eye_distance_m = 0;     // of a perspective eye from the middle; 0: orthographic
  Ray ray(double x, double y) const;
};
// Fits the frame into width x height pixels. `fov_deg`: full angle across the larger side; 0: orthographic.
// A `metres_per_pixel` above 0 is kept (several views at one scale); orthographic only.
PictureCamera fit_camera(const Scene& scene, const PictureView& view, double width, double height,
                         double fov_deg, double metres_per_pixel = 0);

}  // namespace bpms
