// How the errors of the rig reach a pixel: the columns of the rig's covariance, matched to the derivatives
// that a Projection carries.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "calibrate/rig.h"
#include "reconstruct/reconstruct.h"

namespace bpms {

class RigErrors {
 public:
  // Without a covariance there are no errors: size() is 0. A name in its order that is no parameter is bad
  // input.
  explicit RigErrors(const Rig& rig);
  Eigen::Index size() const { return covariance_.rows(); }
  const Eigen::MatrixXd& covariance() const { return covariance_; }
  // Derivatives of proj/sigma by the rig's free parameters, 2 rows a sighting.
  Eigen::MatrixXd by_rig(const std::vector<Sighting>& sightings,
                         const std::vector<Projection>& projections) const;

 private:
  struct Column {
    int camera;
    Eigen::Index parameter;  // in [lens parameters, pose]
  };
  std::vector<Column> columns_;
  Eigen::MatrixXd covariance_;
};

}  // namespace bpms
