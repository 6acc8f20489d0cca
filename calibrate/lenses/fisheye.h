// Fisheye lens of Kannala & Brandt 2006 in OpenCV's order of parameters (cv::fisheye), fx fy cx cy k1 k2 k3
// k4:
//   r = |(X, Y)|, theta = atan2(r, Z), theta_d = theta (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4
//   theta^8) u = fx theta_d X/r + cx,  v = fy theta_d Y/r + cy
// theta may exceed 90 degrees (Z < 0). Defined as far from the axis as theta_d rises strictly. Pixel centres
// are integers.
#pragma once
#include "calibrate/lenses/lens.h"

namespace bpms {
const Lens& fisheye_lens();
}
