// Reflection from a rough surface of small smooth facets (Torrance & Sparrow 1967; Cook & Torrance 1982), as
// of waxy leaves (Bousquet et al. 2005):
//   BRDF = F(c) D(h) G / (4 mu mu'),  h halfway between view and light, c = cosine of view to h
// F: Fresnel for a refractive index n. D: distribution of the facets' slopes, Beckmann (slopes are normal,
// rms alpha/sqrt(2) in each direction) or GGX (Walter et al. 2007; longer tails). G: Smith's masking and
// shadowing, correlated by height (Heitz 2014). What facets throw onto each other is lost.
#pragma once
#include <vector>

#include "simulate/materials/lobe.h"

namespace bpms {

enum class FacetSlopes { ggx, beckmann };

class RoughSpecular : public Lobe {
 public:
  // One refractive index, separable with spectrum 1; or one for each band.
  RoughSpecular(FacetSlopes slopes, double alpha, std::vector<double> index, bool separable);

  bool separable() const override { return separable_; }
  float shape(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const override;
  void values(const Eigen::Vector3f& view, const Eigen::Vector3f& light, std::span<float> out) const override;
  // From the GGX facets that the view sees (Heitz 2018), for Beckmann's too: the weight stays below F times
  // 1 (GGX) and 4 sqrt(pi) / e (Beckmann: a tail and a masking that are lighter by so much).
  bool sample(const Eigen::Vector3f& view, float u, float v, Eigen::Vector3f& light) const override;
  float pdf(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const override;
  float typical_albedo() const override { return typical_albedo_; }

  // Directional albedo for each refractive index, at the cosine (node / (nodes - 1))^2, in order of `index`:
  // nodes are dense towards the horizon, where it rises.
  static constexpr std::size_t nodes = 65;
  std::vector<std::vector<double>> albedo() const;

 private:
  struct Facet {
    double cosine;  // of the view to the facet's normal
    double factor;  // of F: D G / (4 mu mu'); 0: no such facet
  };
  Facet facet(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const;

  FacetSlopes slopes_;
  double alpha_;
  std::vector<double> index_;
  bool separable_;
  float typical_albedo_ = 0;
};

}  // namespace bpms
