// Rows that several stages exchange, and their CSV files (points.csv, vectors.csv).
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/error.h"

namespace bpms {

// What a digitised point or vector belongs to: plant, axis, rank of the organ, kind of organ, feature of it,
// point.
struct OrganLabel {
  std::string plant;
  std::string axis;
  int rank = 0;
  std::string organ;    // leaf, stem, bud, head; others are carried along
  std::string feature;  // midrib, edge_left, edge_right, axis, outline
  auto operator<=>(const OrganLabel&) const = default;
  std::string str() const;  // "plant 1 axis 1 rank 3 leaf midrib"
};

// A point digitised in one image. Pixel centres are integers (OpenCV's convention).
struct ImagePoint {
  OrganLabel label;
  int point = 0;
  std::string view;    // the frame (date, turn of the plant, ...) the image belongs to
  std::string camera;  // name of the camera in the rig
  double u_px = 0;
  double v_px = 0;
  double sigma_px = 0;  // per axis
  SourceLocation where;
};

// A labelled 3-D point with its covariance (m^2).
struct VectorPoint {
  OrganLabel label;
  int point = 0;
  Eigen::Vector3d x_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
  SourceLocation where;
};

// plant,axis,rank,organ,feature,point,view,camera,u_px,v_px,sigma_px
std::vector<ImagePoint> read_image_points(const std::string& path);
// plant,axis,rank,organ,feature,point,x_m,y_m,z_m,xx,xy,xz,yy,yz,zz (covariance columns may be absent: zero)
std::vector<VectorPoint> read_vectors(const std::string& path);
std::string vectors_csv(const std::vector<VectorPoint>& points);

}  // namespace bpms
