// A surface of which a fraction is of each of other materials, finer than anything that is traced: diffuse
// parts and lobes add up.
#include <cmath>

#include "simulate/materials/delta_lobes.h"
#include "simulate/materials/material.h"

namespace bpms {
namespace {

// A lobe with values of its own in each band, times a fraction that depends on the band.
class WeightedLobe : public Lobe {
 public:
  WeightedLobe(std::shared_ptr<const Lobe> lobe, const std::vector<double>& fraction)
      : lobe_(std::move(lobe)), fraction_(fraction.begin(), fraction.end()) {
    for (const float part : fraction_) mean_ += part / static_cast<float>(fraction_.size());
  }
  bool separable() const override { return false; }
  float shape(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const override {
    return mean_ * lobe_->shape(view, light);  // exact where the fractions are flat
  }
  void values(const Eigen::Vector3f& view, const Eigen::Vector3f& light,
              std::span<float> out) const override {
    lobe_->values(view, light, out);
    for (std::size_t band = 0; band < out.size(); ++band) out[band] *= fraction_[band];
  }
  bool sample(const Eigen::Vector3f& view, float u, float v, Eigen::Vector3f& light) const override {
    return lobe_->sample(view, u, v, light);
  }
  float pdf(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const override {
    return lobe_->pdf(view, light);
  }
  float typical_albedo() const override { return mean_ * lobe_->typical_albedo(); }
  bool reciprocal() const override { return lobe_->reciprocal(); }
  bool empirical() const override { return lobe_->empirical(); }

 private:
  std::shared_ptr<const Lobe> lobe_;
  std::vector<float> fraction_;
  float mean_ = 0;
};

void add_part(Material& mixture, const Material& part, const std::vector<double>& fraction) {
  const auto add = [&](std::vector<double>& sum, const std::vector<double>& spectrum) {
    for (std::size_t band = 0; band < sum.size(); ++band) sum[band] += fraction[band] * spectrum[band];
  };
  for (std::size_t face = 0; face < 2; ++face) add(mixture.reflectance[face], part.reflectance[face]);
  add(mixture.transmittance, part.transmittance);
  mixture.opaque = mixture.opaque && part.opaque;
  for (SurfaceLobe lobe : part.lobes) {
    if (lobe.lobe->separable())
      for (std::size_t band = 0; band < fraction.size(); ++band) lobe.spectrum[band] *= fraction[band];
    else
      lobe.lobe = std::make_shared<WeightedLobe>(lobe.lobe, fraction);
    mixture.lobes.push_back(std::move(lobe));
  }
  for (const std::string& note : part.notes) mixture.notes.push_back(part.name + ": " + note);
}

}  // namespace

Material read_mixture(const TomlValue& table, MaterialContext& context) {
  Material out = black_material(context.bands(), true);
  const TomlValue of = table.require("of");
  if (!of.is_table() || of.keys().empty())
    of.reject("expected a table of fractions, { name = 0.7, other = 0.3 }");
  std::vector<double> sum(context.bands().count(), 0.0);
  for (const std::string& name : of.keys()) {
    const TomlValue given = of.require(name);
    const std::vector<double> fraction = context.spectrum(given, 0.0, 1.0);
    const Material& part = context.material(name, given);
    if (part.map || part.bump)
      given.reject(fmt::format("{} is a {}: expected materials without maps and bumps", name,
                               part.map ? "map" : "material with a bump"));
    for (std::size_t band = 0; band < sum.size(); ++band) sum[band] += fraction[band];
    add_part(out, part, fraction);
  }
  constexpr double written = 1e-6;  // thirds, as people write them
  for (std::size_t band = 0; band < sum.size(); ++band)
    if (std::abs(sum[band] - 1) > written)
      of.reject(
          fmt::format("fractions add up to {} in {}: expected 1", sum[band], context.bands().name(band)));
  return out;
}

}  // namespace bpms
