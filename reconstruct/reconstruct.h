// The noun of reconstruction: labelled 3-D points with their covariance, from points digitised in the images
// of a rig.
//
// Frame: the rig's, metres, until a Frame (points/frame.h) is applied. A point is what shares label, number
// and view; its sightings are the images it was digitised in. Estimator: maximum likelihood under independent
// Gaussian pixel errors of the given sigma per axis (points/triangulation.h). Covariance: digitising error
// and rig error apart; the rig's part is common to all points of a rig and does not average out over them, so
// the covariance given here is that of each point alone. Gate: chi-square of the residuals, 2N - 3 degrees of
// freedom for N images (points/gate.h).
#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/rig.h"
#include "core/records.h"

namespace bpms {

struct ReconstructOptions {
  double gate_p = 0.01;             // a point whose chi-square has a smaller probability than this is refused
  bool with_rig_covariance = true;  // false: as if the rig were known exactly
  std::optional<std::string> view;  // only this view of the points
};

struct Sighting {
  int camera = 0;  // index in the rig
  Eigen::Vector2d pixel;
  double sigma_px = 1;
};

struct PointEstimate {
  Eigen::Vector3d x_m;  // in the rig's frame
  Eigen::Matrix3d digitising_covariance_m2;
  Eigen::Matrix3d rig_covariance_m2;
  Eigen::MatrixXd by_rig;  // dx/db, 3 x the rig's covariance order (empty without it)
  double chi2 = 0;
  int dof = 0;
  double p = 1;                              // probability of a larger chi2
  std::vector<Eigen::Vector2d> reprojected;  // for each sighting
  Eigen::Matrix3d covariance_m2() const { return digitising_covariance_m2 + rig_covariance_m2; }
};

struct ReconstructedPoint {
  OrganLabel label;
  int point = 0;
  std::string view;
  SourceLocation where;  // of its first sighting
  std::vector<Sighting> sightings;
  // Why the point was refused; empty for an accepted one: "chi2", "seen in one image only", "behind a
  // camera", "parallel rays", "did not converge", "outside the lens model".
  std::string reason;

  // Known where triangulation came to an end: accepted points, and those with the reason "chi2".
  std::optional<PointEstimate> estimate;

  bool accepted() const { return reason.empty(); }
  std::string str() const;  // "plant 1 axis 1 rank 3 leaf midrib point 4"
};

struct Vectors {
  std::vector<ReconstructedPoint> points;  // accepted and refused, in the order of their labels
  std::vector<std::string> notes;          // in words, for the user
  std::vector<VectorPoint> accepted() const;
  std::size_t refused() const;
  // Per axis, over the accepted points, no correction for degrees of freedom.
  double reprojection_rms_px() const;
};

// A view is one frame of the whole rig. Where every camera has one view and every view one camera, the views
// are taken for the names of the images of a single frame (noted). A camera that the rig does not have, a
// pixel outside its image, or a point in two views at once is bad input.
Vectors reconstruct(const std::vector<ImagePoint>& points, const Rig& rig,
                    const ReconstructOptions& options = {});

}  // namespace bpms
