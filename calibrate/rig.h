// The noun of calibration: cameras with lens models and poses, and the covariance of all of it.
// Frames: X_cam = R X_rig + t with x right, y down, z forward. Pixel centres are integers (OpenCV's
// convention).
#pragma once
#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"

namespace bpms {

struct Camera {
  std::string name;
  int width_px = 0;
  int height_px = 0;
  std::string model = "brown_conrady";
  // fx fy cx cy, then what the model (calibrate/lenses/) has. brown_conrady: [k1 k2 p1 p2 [k3 [k4 k5 k6]]],
  // OpenCV's order.
  std::vector<double> parameters;
  std::vector<double> constants = {};  // what the model is set up with; most have none
  Eigen::Matrix3d r_cam_from_rig = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t_cam_from_rig_m = Eigen::Vector3d::Zero();
  std::map<std::string, std::string> identity;  // serial, lens, focus, aperture, date, ...

  Eigen::Vector3d camera_from_rig(const Eigen::Vector3d& x_rig) const {
    return r_cam_from_rig * x_rig + t_cam_from_rig_m;
  }
};

// Pixel of a point in the camera's frame; nullopt for z <= 0 or outside the model's monotone region.
std::optional<Eigen::Vector2d> project(const Camera& camera, const Eigen::Vector3d& x_cam);
// The pixel of a rig point and its derivatives: by the point in the rig frame, by the camera's parameters,
// and by the pose (rotation vector of a left perturbation R <- exp(w) R, then t).
struct Projection {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, 3> by_point;
  Eigen::Matrix<double, 2, Eigen::Dynamic> by_parameters;
  Eigen::Matrix<double, 2, 6> by_pose;
};
std::optional<Projection> project_with_derivatives(const Camera& camera, const Eigen::Vector3d& x_rig);
// Unit ray in the camera's frame of a pixel (Newton with the analytic Jacobian); nullopt when it does not
// converge.
std::optional<Eigen::Vector3d> unproject(const Camera& camera, const Eigen::Vector2d& pixel);

struct Rig {
  std::vector<Camera> cameras;
  // Of the free parameters named in `order`, camera by camera: "left.fx" ... "left.k1" ..., then "right.rx"
  // "right.ry" "right.rz" (left-perturbation rotation vector) "right.tx" "right.ty" "right.tz". Empty when
  // not known.
  struct Covariance {
    std::vector<std::string> order;
    Eigen::MatrixXd matrix;
    std::string kind = "iid";  // or "clustered"
    // Of a clustered covariance, where known: the frames it was made from, and what the sigmas of `order`
    // would be if corners erred independently. The rest of a variance, times the frames, is what one frame
    // adds.
    int frames = 0;
    Eigen::VectorXd sigma_iid = {};
  };
  std::optional<Covariance> covariance;
  double residual_sigma_px = 0;  // 0: not known

  int find(const std::string& camera) const;  // index, or -1
};

// Names of a camera's parameters in the order of Camera::parameters ("fx" ... ), then "rx ry rz tx ty tz".
std::vector<std::string> parameter_names(const Camera& camera);

Rig read_rig(const std::string& path);
std::string rig_toml(const Rig& rig, const std::string& comment = {});

}  // namespace bpms
