// One view of shared paths: what its own rays see of the sun's light of order 1, and what the photon paths'
// vertices send to it of all other light; by batch and order.
#pragma once
#include <memory>
#include <vector>

#include "simulate/forward/path_vertices.h"
#include "simulate/transport/basis.h"
#include "simulate/transport/estimate.h"
#include "simulate/transport/sums.h"

namespace bpms {

class ViewSums {
 public:
  ViewSums(const PhotonStage& stage, const Sensor& sensor, std::size_t view, int orders);

  // The view's own rays, samples [rays done ... last) of each batch: first hits, and from there the suns.
  // `sun_rays`: by source, or null.
  void add_rays(const ViewKey& key, const ParallelRays* view_rays,
                const std::vector<const ParallelRays*>& sun_rays, std::uint64_t last);
  // Of the samples [photons done ... last) among these vertices. `ends`: they hold all of those.
  void add_vertices(const PathVertices& vertices, const ParallelRays* view_rays, std::uint64_t last);
  void end_photons(std::uint64_t last) { photons_ = last; }

  std::uint64_t rays() const { return rays_; }        // a batch
  std::uint64_t photons() const { return photons_; }  // a batch
  BatchMeans means(std::size_t batch) const;
  const ViewCounts& counts(std::size_t batch) const { return counts_[batch]; }
  // Of the total's parts, per written band: the variance of one ray and of one photon path, for plans: from
  // more groups than there are batches, since 32 means leave a variance a quarter uncertain.
  struct Variances {
    std::vector<double> ray, photon, standard_error, value;
  };
  Variances variances(const Sources& sources) const;

 private:
  void add_sun(std::size_t batch, std::size_t group, std::size_t sun, const Eigen::Vector3f& towards,
               const ParallelRays* rays, const Hit& hit);
  double* sum(std::size_t batch, std::size_t row) {
    return sums_.data() + (batch * rows_.count() + row) * stage_->optics.bands;
  }
  const double* sum(std::size_t batch, std::size_t row) const {
    return sums_.data() + (batch * rows_.count() + row) * stage_->optics.bands;
  }
  const PhotonStage* stage_;
  const Sensor* sensor_;
  std::size_t view_;
  Rows rows_;
  Eigen::Vector3f towards_;
  std::vector<double> cos_radius_;  // by sun
  std::vector<Basis> frames_;       // by sun, about its centre
  std::uint64_t rays_ = 0, photons_ = 0;
  std::vector<double> sums_;  // batches x rows of BatchMeans x bands
  std::vector<ViewCounts> counts_;
  static constexpr std::size_t groups = 8;          // of a batch, by sample
  std::vector<double> ray_groups_, photon_groups_;  // totals in units of radiance: batches x groups x bands
  std::vector<std::vector<double>> unit_;           // radiance per unit of a row, per source and band
};

}  // namespace bpms
