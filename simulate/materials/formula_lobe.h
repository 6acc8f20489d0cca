// A lobe of reflection given by a formula for the BRF, with one set of parameters for each band or one for
// all: what RPV, Hapke, Verstraete-Pinty-Dickinson and tables of measurements have in common.
#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "simulate/materials/hemisphere_sampler.h"
#include "simulate/materials/lobe.h"
#include "simulate/materials/reflection_angles.h"

namespace bpms {

class FormulaLobe : public Lobe {
 public:
  // Of the band; of band 0 where one set of parameters serves all (`separable`).
  virtual double brf(const ReflectionAngles& angles, std::size_t band) const = 0;

  bool separable() const override { return separable_; }
  float shape(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const override;
  void values(const Eigen::Vector3f& view, const Eigen::Vector3f& light, std::span<float> out) const override;
  bool sample(const Eigen::Vector3f& view, float u, float v, Eigen::Vector3f& light) const override {
    return sampler_->sample(view, u, v, light);
  }
  float pdf(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const override {
    return sampler_->pdf(view, light);
  }
  float typical_albedo() const override { return sampler_->albedo(); }
  bool empirical() const override { return true; }

 protected:
  FormulaLobe(std::size_t sets, bool separable) : sets_(sets), separable_(separable) {}
  // The last line of a constructor; `exponent` as HemisphereSampler has it.
  void make_sampler(double exponent);

 private:
  std::size_t sets_;
  bool separable_;
  std::optional<HemisphereSampler> sampler_;
};

// A formula with its sets of parameters: separable with one, else one for each band. `exponent` as
// HemisphereSampler has it.
template <class Parameters, double (*formula)(const Parameters&, const ReflectionAngles&),
          bool is_reciprocal = true>
class ParametricLobe final : public FormulaLobe {
 public:
  ParametricLobe(std::vector<Parameters> parameters, bool separable, double exponent)
      : FormulaLobe(parameters.size(), separable), parameters_(std::move(parameters)) {
    make_sampler(exponent);
  }
  double brf(const ReflectionAngles& angles, std::size_t band) const override {
    return formula(parameters_[band], angles);
  }
  bool reciprocal() const override { return is_reciprocal; }

 private:
  std::vector<Parameters> parameters_;
};

}  // namespace bpms
