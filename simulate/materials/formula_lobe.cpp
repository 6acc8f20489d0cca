#include "simulate/materials/formula_lobe.h"

#include "core/units.h"

namespace bpms {

float FormulaLobe::shape(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const {
  if (!(view.z() > 0 && light.z() > 0)) return 0;
  const ReflectionAngles angles = reflection_angles(view.cast<double>(), light.cast<double>());
  double sum = 0;
  for (std::size_t band = 0; band < sets_; ++band) sum += brf(angles, band);
  return static_cast<float>(sum / (pi * static_cast<double>(sets_)));
}

void FormulaLobe::values(const Eigen::Vector3f& view, const Eigen::Vector3f& light,
                         std::span<float> out) const {
  if (!(view.z() > 0 && light.z() > 0)) {
    std::fill(out.begin(), out.end(), 0.0f);
    return;
  }
  const ReflectionAngles angles = reflection_angles(view.cast<double>(), light.cast<double>());
  for (std::size_t band = 0; band < out.size(); ++band)
    out[band] = static_cast<float>(brf(angles, sets_ == 1 ? 0 : band) / pi);
}

void FormulaLobe::make_sampler(double exponent) {
  sampler_.emplace(sets_, exponent,
                   [this](const Eigen::Vector3f& view, const Eigen::Vector3f& light, std::span<float> out) {
                     values(view, light, out);
                   });
}

}  // namespace bpms
