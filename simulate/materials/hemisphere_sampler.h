// Draws directions over the upper hemisphere about as an isotropic reflecting lobe does, whatever its
// formula: a density that is constant, relative to a simple one, over cells of (zenith, azimuth relative to
// the view), tabulated for some zeniths of the view and mixed linearly between them.
//
// The simple density is proportional to cos(zenith)^(exponent - 1): 2 is Lambert's law; formulas that grow
// towards the horizon ask for less, so that weights stay bounded there. A tenth of the draws follow it alone.
#pragma once
#include <Eigen/Core>
#include <array>
#include <functional>
#include <span>
#include <vector>

namespace bpms {

class HemisphereSampler {
 public:
  // `values` fills one value of the BRDF for each of `bands`; the density is the mean over the bands of what
  // each would draw.
  using Values =
      std::function<void(const Eigen::Vector3f& view, const Eigen::Vector3f& light, std::span<float> out)>;
  HemisphereSampler(std::size_t bands, double exponent, const Values& values);

  bool sample(const Eigen::Vector3f& view, float u, float v, Eigen::Vector3f& light) const;
  float pdf(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const;
  float albedo() const { return albedo_; }  // mean over bands and tabulated views

 private:
  static constexpr std::size_t views = 16, zeniths = 16, azimuths = 16;
  struct Row {                                                           // for one zenith of the view
    std::array<float, zeniths + 1> below;                                // cumulative over the zeniths' cells
    std::array<std::array<float, azimuths + 1>, zeniths> below_azimuth;  // within each
    std::array<std::array<float, azimuths>, zeniths> relative;           // density over the simple one
  };
  struct Between {
    std::size_t row;
    float to_next;
  };
  static Between between(float view_cosine);
  float simple(float cosine) const;

  float exponent_;
  std::vector<Row> rows_;
  float albedo_ = 0;
};

}  // namespace bpms
