#include "reconstruct/points/rig_errors.h"

#include "core/nearest.h"

namespace bpms {

RigErrors::RigErrors(const Rig& rig) {
  if (!rig.covariance) return;
  std::vector<std::string> names;
  std::vector<Column> columns;
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    Eigen::Index at = 0;
    for (const std::string& name : parameter_names(rig.cameras[c])) {
      names.push_back(rig.cameras[c].name + "." + name);
      columns.push_back({static_cast<int>(c), at++});
    }
  }
  for (const std::string& wanted : rig.covariance->order) {
    const auto found = std::find(names.begin(), names.end(), wanted);
    if (found == names.end())
      bad_input({}, "the rig's covariance names {}, which is no parameter of its cameras{}",
                in_quotes(wanted), did_you_mean(wanted, names));
    columns_.push_back(columns[static_cast<std::size_t>(found - names.begin())]);
  }
  covariance_ = rig.covariance->matrix;
  const auto size = static_cast<Eigen::Index>(columns_.size());
  if (covariance_.rows() != size || covariance_.cols() != size)
    bad_input({}, "the rig's covariance is {}x{}, its order names {} parameters", covariance_.rows(),
              covariance_.cols(), size);
}

Eigen::MatrixXd RigErrors::by_rig(const std::vector<Sighting>& sightings,
                                  const std::vector<Projection>& projections) const {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(2 * sightings.size()), size());
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const Projection& projection = projections[i];
    const Eigen::Index lens = projection.by_parameters.cols();
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (columns_[k].camera != sightings[i].camera) continue;
      const Eigen::Index p = columns_[k].parameter;
      const Eigen::Vector2d derivative = p < lens ? Eigen::Vector2d(projection.by_parameters.col(p))
                                                  : Eigen::Vector2d(projection.by_pose.col(p - lens));
      out.block<2, 1>(static_cast<Eigen::Index>(2 * i), static_cast<Eigen::Index>(k)) =
          derivative / sightings[i].sigma_px;
    }
  }
  return out;
}

}  // namespace bpms
