#include "simulate/materials/beneath_surface.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace bpms {

EnteringLight::EnteringLight(const std::vector<std::vector<double>>& albedo)
    : nodes_(albedo.front().size(), std::vector<float>(albedo.size())), mean_(albedo.size()) {
  for (std::size_t set = 0; set < albedo.size(); ++set)
    for (std::size_t node = 0; node < nodes_.size(); ++node)
      nodes_[node][set] = static_cast<float>(1 - albedo[set][node]);
  // 2 integral of C mu dmu in x = sqrt(mu), where C is straight between nodes and 4 C x^3 of the fourth
  // degree: Simpson's rule over sixteenths of the pieces is off by 1e-8.
  const std::size_t steps = 16 * (nodes_.size() - 1);
  const auto add = [&](std::size_t i, double weight) {
    const double x = static_cast<double>(i) / (2.0 * static_cast<double>(steps));
    const At at(*this, static_cast<float>(x * x));
    for (std::size_t set = 0; set < mean_.size(); ++set)
      mean_[set] +=
          weight * 4 * x * x * x * static_cast<double>(at(set)) / (6.0 * static_cast<double>(steps));
  };
  for (std::size_t i = 0; i <= 2 * steps; ++i) add(i, i % 2 == 1 ? 4 : i == 0 || i == 2 * steps ? 1 : 2);
}

EnteringLight::At::At(const EnteringLight& light, float cosine) : one_(light.sets() == 1) {
  const auto pieces = static_cast<float>(light.nodes_.size() - 1);
  const float at = std::sqrt(std::clamp(cosine, 0.0f, 1.0f)) * pieces;
  const std::size_t below = std::min(static_cast<std::size_t>(at), light.nodes_.size() - 2);
  low_ = light.nodes_[below].data();
  high_ = light.nodes_[below + 1].data();
  t_ = at - static_cast<float>(below);
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

float BeneathSurface::shape(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const {
  if (!on_its_side(light)) return 0;
  const EnteringLight::At out(*view_face_, view.z()), in(*light_face_, std::abs(light.z()));
  float sum = 0;
  for (std::size_t set = 0; set < per_n_.size(); ++set)
    sum += (separable() ? 1 : scattered_[set]) * out(set) * in(set)*per_n_[set];
  return sum / static_cast<float>(per_n_.size());
}

void BeneathSurface::values(const Eigen::Vector3f& view, const Eigen::Vector3f& light,
                            std::span<float> out) const {
  if (!on_its_side(light)) {
    std::fill(out.begin(), out.end(), 0.0f);
    return;
  }
  const EnteringLight::At leaves(*view_face_, view.z()), enters(*light_face_, std::abs(light.z()));
  for (std::size_t band = 0; band < out.size(); ++band)
    out[band] = scattered_[band] * leaves(band) * enters(band) * per_n_[band];
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
