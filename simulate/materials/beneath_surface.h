// What a leaf scatters diffusely beneath a shiny surface, so that light which the surface reflects is not
// counted twice. With the surface's directional albedo A and C(mu) = 1 - A(mu):
//   reflected    BRDF = rho C(mu) C(mu') / (pi N),  N = 2 integral of C mu dmu
//   transmitted  BTDF = tau C_1(mu) C_2(mu') / (pi N'), each C of the face on its side, N' the larger N
// (Kelemen & Szirmay-Kalos 2001). Reciprocal; light from mu gives out A + (rho + tau) C <= 1 where
// rho + tau <= 1: reflectance and transmittance are those of the light that has entered.
#pragma once
#include <memory>
#include <vector>

#include "simulate/materials/lobe.h"

namespace bpms {

// 1 - A over the cosine, in nodes as RoughSpecular::albedo has them; one set, or one for each band.
class EnteringLight {
 public:
  EnteringLight() : nodes_(2, {1.0f}), mean_{1.0} {}  // a bare face: all enters
  explicit EnteringLight(const std::vector<std::vector<double>>& albedo);
  std::size_t sets() const { return mean_.size(); }
  double mean(std::size_t set) const { return mean_[sets() == 1 ? 0 : set]; }  // N

  // At one cosine, for any set.
  class At {
   public:
    At(const EnteringLight& light, float cosine);
    float operator()(std::size_t set) const {
      const std::size_t i = one_ ? 0 : set;
      return low_[i] + t_ * (high_[i] - low_[i]);
    }

   private:
    bool one_;
    const float* low_;
    const float* high_;
    float t_;
  };

 private:
  std::vector<std::vector<float>> nodes_;  // by node, each by set
  std::vector<double> mean_;
};

class BeneathSurface : public Lobe {
 public:
  // `scattered`: rho or tau of each band where the lobe is not separable, else empty (the spectrum outside).
  BeneathSurface(std::shared_ptr<const EnteringLight> view_face,
                 std::shared_ptr<const EnteringLight> light_face, bool transmits,
                 std::vector<double> scattered);
  bool separable() const override { return scattered_.empty(); }
  float shape(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const override;
  void values(const Eigen::Vector3f& view, const Eigen::Vector3f& light, std::span<float> out) const override;
  bool sample(const Eigen::Vector3f& view, float u, float v, Eigen::Vector3f& light) const override;
  float pdf(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const override;
  float typical_albedo() const override { return typical_albedo_; }

 private:
  bool on_its_side(const Eigen::Vector3f& light) const { return (light.z() < 0) == transmits_; }
  std::shared_ptr<const EnteringLight> view_face_, light_face_;
  bool transmits_;
  std::vector<float> scattered_;
  std::vector<float> per_n_;  // 1 / (pi N)
  float typical_albedo_ = 0;
};

}  // namespace bpms
