#include "simulate/materials/beneath_surface.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace bpms {

EnteringLight::EnteringLight(const std::vector<std::vector<double>>& albedo) {
  for (const std::vector<double>& set : albedo) {
    std::vector<float> parts;
    for (const double reflected : set) parts.push_back(static_cast<float>(1 - reflected));
    sets_.push_back(std::move(parts));
  }
  // 2 integral of C mu dmu in x = sqrt(mu), in which C is piecewise linear: 4 C x^3 dx, exact by Simpson's
  // rule of two halves for the product's fourth degree but for 1e-7.
  for (std::size_t set = 0; set < sets_.size(); ++set) {
    double sum = 0;
    constexpr int steps = 1024;
    const auto integrand = [&](double x) {
      return 4 * x * x * x * static_cast<double>(part(static_cast<float>(x * x), set));
    };
    for (int i = 0; i < steps; ++i) {
      const double low = static_cast<double>(i) / steps, high = (i + 1.0) / steps;
      sum += (integrand(low) + 4 * integrand((low + high) / 2) + integrand(high)) / (6 * steps);
    }
    mean_.push_back(sum);
  }
}

float EnteringLight::part(float cosine, std::size_t set) const {
  const std::vector<float>& parts = sets_[sets_.size() == 1 ? 0 : set];
  const float at = std::sqrt(std::clamp(cosine, 0.0f, 1.0f)) * static_cast<float>(parts.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), parts.size() - 2);
  return parts[below] + (at - static_cast<float>(below)) * (parts[below + 1] - parts[below]);
}

BeneathSurface::BeneathSurface(std::shared_ptr<const EnteringLight> view_face,
                               std::shared_ptr<const EnteringLight> light_face, bool transmits,
                               std::vector<double> scattered)
    : view_face_(std::move(view_face)),
      light_face_(std::move(light_face)),
      transmits_(transmits),
      scattered_(scattered.begin(), scattered.end()) {
  const std::size_t sets = std::max(view_face_->sets(), light_face_->sets());
  double albedo = 0;
  for (std::size_t set = 0; set < sets; ++set) {
    const double n = std::max(view_face_->mean(set), light_face_->mean(set));
    per_n_.push_back(static_cast<float>(1 / (pi * n)));
    albedo += view_face_->mean(set) * light_face_->mean(set) / n * (scattered.empty() ? 1 : scattered[set]);
  }
  typical_albedo_ = static_cast<float>(albedo / static_cast<double>(sets));
}

float BeneathSurface::of_set(const Eigen::Vector3f& view, const Eigen::Vector3f& light,
                             std::size_t set) const {
  return view_face_->part(view.z(), set) * light_face_->part(std::abs(light.z()), set) * per_n_[set];
}

float BeneathSurface::shape(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const {
  if (!on_its_side(light)) return 0;
  if (separable()) return of_set(view, light, 0);
  float sum = 0;
  for (std::size_t set = 0; set < per_n_.size(); ++set) sum += scattered_[set] * of_set(view, light, set);
  return sum / static_cast<float>(per_n_.size());
}

void BeneathSurface::values(const Eigen::Vector3f& view, const Eigen::Vector3f& light,
                            std::span<float> out) const {
  const bool here = on_its_side(light);
  for (std::size_t band = 0; band < out.size(); ++band)
    out[band] = here ? scattered_[band] * of_set(view, light, band) : 0;
}

bool BeneathSurface::sample(const Eigen::Vector3f&, float u, float v, Eigen::Vector3f& light) const {
  const float radius = std::sqrt(u), turn = 2 * static_cast<float>(pi) * v;
  const float z = std::sqrt(std::max(1 - u, 1e-12f));
  light = {radius * std::cos(turn), radius * std::sin(turn), transmits_ ? -z : z};
  return true;
}

float BeneathSurface::pdf(const Eigen::Vector3f&, const Eigen::Vector3f& light) const {
  return on_its_side(light) ? std::abs(light.z()) / static_cast<float>(pi) : 0;
}

}  // namespace bpms
