#include "simulate/materials/rough_specular.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "simulate/materials/dielectric_surface.h"

namespace bpms {
namespace {

// Density of facets with this normal, per steradian and unit of the surface's area.
double facet_density(FacetSlopes slopes, double alpha, const Eigen::Vector3d& h) {
  const double up2 = h.z() * h.z();
  const double slope2 = h.head<2>().squaredNorm() / (up2 * alpha * alpha);
  const double scale = pi * alpha * alpha * up2 * up2;
  if (slopes == FacetSlopes::beckmann) return std::exp(-slope2) / scale;
  return 1 / (scale * (1 + slope2) * (1 + slope2));
}

// Smith's auxiliary function: hidden over seen area of facets.
double facets_hidden(FacetSlopes slopes, double alpha, const Eigen::Vector3d& direction) {
  const double slope = alpha * direction.head<2>().norm() / direction.z();
  if (!(slope > 0)) return 0;
  if (slopes == FacetSlopes::ggx) return (std::sqrt(1 + slope * slope) - 1) / 2;
  const double a = 1 / slope;
  return (std::exp(-a * a) / (a * std::sqrt(pi)) - std::erfc(a)) / 2;
}

}  // namespace

RoughSpecular::RoughSpecular(FacetSlopes slopes, double alpha, std::vector<double> index, bool separable)
    : slopes_(slopes), alpha_(alpha), index_(std::move(index)), separable_(separable) {
  double sum = 0;
  for (const double n : index_) sum += 1 - cone_transmittance(pi / 2, n);
  typical_albedo_ = static_cast<float>(sum / static_cast<double>(index_.size()));
}

RoughSpecular::Facet RoughSpecular::facet(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const {
  if (!(view.z() > 0 && light.z() > 0)) return {0, 0};
  const Eigen::Vector3d v = view.cast<double>(), l = light.cast<double>();
  const Eigen::Vector3d h = (v + l).normalized();
  const double seen = 1 / (1 + facets_hidden(slopes_, alpha_, v) + facets_hidden(slopes_, alpha_, l));
  return {std::clamp(v.dot(h), 0.0, 1.0), facet_density(slopes_, alpha_, h) * seen / (4 * v.z() * l.z())};
}

float RoughSpecular::shape(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const {
  const Facet met = facet(view, light);
  if (!(met.factor > 0)) return 0;
  double sum = 0;
  for (const double n : index_) sum += fresnel_reflectance(met.cosine, n);
  return static_cast<float>(met.factor * sum / static_cast<double>(index_.size()));
}

void RoughSpecular::values(const Eigen::Vector3f& view, const Eigen::Vector3f& light,
                           std::span<float> out) const {
  const Facet met = facet(view, light);
  for (std::size_t band = 0; band < out.size(); ++band)
    out[band] = static_cast<float>(met.factor *
                                   fresnel_reflectance(met.cosine, index_[index_.size() == 1 ? 0 : band]));
}

bool RoughSpecular::sample(const Eigen::Vector3f& view, float u, float v, Eigen::Vector3f& light) const {
  // Stretched by alpha the facets are those of a hemisphere, and the view sees its projection: a half disc
  // and a half ellipse.
  const Eigen::Vector3d from = view.cast<double>();
  const Eigen::Vector3d stretched =
      Eigen::Vector3d(alpha_ * from.x(), alpha_ * from.y(), from.z()).normalized();
  const double across2 = stretched.head<2>().squaredNorm();
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  if (across2 > 0) right = Eigen::Vector3d(-stretched.y(), stretched.x(), 0) / std::sqrt(across2);
  const Eigen::Vector3d up = stretched.cross(right);
  const double radius = std::sqrt(static_cast<double>(u)), turn = 2 * pi * static_cast<double>(v);
  const double x = radius * std::cos(turn);
  const double share = (1 + stretched.z()) / 2;
  const double y = (1 - share) * std::sqrt(1 - x * x) + share * radius * std::sin(turn);
  const Eigen::Vector3d round = x * right + y * up + std::sqrt(std::max(0.0, 1 - x * x - y * y)) * stretched;
  const Eigen::Vector3d h =
      Eigen::Vector3d(alpha_ * round.x(), alpha_ * round.y(), std::max(1e-9, round.z())).normalized();
  light = (2 * from.dot(h) * h - from).cast<float>();
  return light.z() > 0;
}

float RoughSpecular::pdf(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const {
  if (!(view.z() > 0 && light.z() > 0)) return 0;
  const Eigen::Vector3d v = view.cast<double>();
  const Eigen::Vector3d h = (v + light.cast<double>()).normalized();
  return static_cast<float>(facet_density(FacetSlopes::ggx, alpha_, h) /
                            (4 * v.z() * (1 + facets_hidden(FacetSlopes::ggx, alpha_, v))));
}

std::vector<std::vector<double>> RoughSpecular::albedo() const {
  // The albedo is linear in F. So the weights of facets are gathered once by the cosine that F depends on,
  // with linear interpolation between nodes that are dense at grazing angles, and then serve every index.
  constexpr std::size_t cosines = 129, grid = 64;
  std::vector<std::vector<double>> out(index_.size(), std::vector<double>(nodes));
  for (std::size_t node = 0; node < nodes; ++node) {
    const double root = static_cast<double>(node) / (nodes - 1), z = std::max(root * root, 1e-4);
    const Eigen::Vector3f view = Eigen::Vector3d(std::sqrt(1 - z * z), 0, z).cast<float>();
    std::vector<double> weight(cosines, 0.0);
    for (std::size_t i = 0; i < grid; ++i) {
      for (std::size_t k = 0; k < grid; ++k) {
        Eigen::Vector3f light;
        if (!sample(view, (static_cast<float>(i) + 0.5f) / grid, (static_cast<float>(k) + 0.5f) / grid,
                    light))
          continue;
        const Facet met = facet(view, light);
        const double at = std::sqrt(met.cosine) * (cosines - 1);
        const std::size_t below = std::min(static_cast<std::size_t>(at), cosines - 2);
        const double low = static_cast<double>(below) / (cosines - 1),
                     high = static_cast<double>(below + 1) / (cosines - 1);
        const double t = (met.cosine - low * low) / (high * high - low * low);
        const double add = met.factor * static_cast<double>(light.z()) /
                           static_cast<double>(pdf(view, light)) / (grid * grid);
        weight[below] += (1 - t) * add;
        weight[below + 1] += t * add;
      }
    }
    for (std::size_t set = 0; set < index_.size(); ++set) {
      double sum = 0;
      for (std::size_t c = 0; c < cosines; ++c) {
        const double cosine_root = static_cast<double>(c) / (cosines - 1);
        sum += weight[c] * fresnel_reflectance(cosine_root * cosine_root, index_[set]);
      }
      out[set][node] = std::min(sum, 1.0);
    }
  }
  return out;
}

}  // namespace bpms
