// A virtual boom (paper, section 4.1.1, figures 9 and 10): a camera is turned about a point and always sees
// the same rectangle of ground, w across the plane of the boom and h along it. It becomes one image a view,
// named NAME_30 or, for a negative zenith, NAME_m30.
//
// Orthographic: the image is w x h cos(vza) and sees the rectangle exactly. Perspective, at distance R from
// the point: the near and the far edge lie at tan(a) = (h/2) cos / (R -+ (h/2) sin) from the line to the
// point; the field is a_near + a_far about its bisector, and the width is right for the line through the
// point. So the middles of the four edges are seen at the middles of the image's edges and at its sides in
// the point's row; the rectangle's image is a trapezoid.
// The far edge is at the top of each image.
#pragma once
#include "simulate/sensors/orthographic.h"
#include "simulate/sensors/perspective.h"
#include "simulate/sensors/view_list.h"

namespace bpms {

struct Boom {
  Eigen::Vector3d about_m = Eigen::Vector3d::Zero();
  double distance_m = 1;
  double width_m = 1, height_m = 1;  // of the rectangle: across and along the plane of the boom
  PixelGrid nadir;                   // the image that looks straight down
};

// Angles between the line to the point and the edges of the rectangle.
struct BoomField {
  double near_edge, far_edge;
};
BoomField boom_field(double height_m, double distance_m, double zenith);

std::unique_ptr<OrthographicSensor> orthographic_on_boom(const Boom& boom, const ViewAngles& view,
                                                         const Domain& domain);
std::unique_ptr<PerspectiveSensor> perspective_on_boom(const Boom& boom, const ViewAngles& view,
                                                       const Domain& domain);

}  // namespace bpms
