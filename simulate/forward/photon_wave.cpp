#include "simulate/forward/photon_wave.h"

#include <array>
#include <cmath>

#include "simulate/transport/basis.h"

namespace bpms {
PhotonStage::PhotonStage(const Simulation& all, const Intersector& rays)
    : simulation(&all),
      intersector(&rays),
      optics(all),
      extent(extent_of(rays)),
      sources(photon_sources(all, extent)) {}

void scatter_diffuse(Photon& photon, const PhotonOptics& optics, const InteractionNumbers& random,
                     float chosen, float* weight) {
  const float share = optics.surface(photon.material).reflect_share[photon.front ? 0 : 1];
  const bool reflect = random.side < static_cast<double>(share);
  multiply_weights(weight,
                   optics.factor(reflect ? reflectance_factor(photon.material, photon.front)
                                         : transmittance_factor(photon.material)),
                   1.0f / ((reflect ? share : 1.0f - share) * chosen), optics.width);
  const Eigen::Vector3f outward = photon.front == reflect ? photon.normal : Eigen::Vector3f(-photon.normal);
  photon.direction = cosine_direction(outward, random.direction_u, random.direction_v);
  photon.scattered = true;
}

bool scatter_lobes(Photon& photon, const PhotonOptics& optics, InteractionNumbers random, float* weight) {
  const SurfaceOptics& surface = optics.surface(photon.material);
  const std::size_t face = photon.front ? 0 : 1;
  const ChosenWay way = choose_way(surface, face, random.side);
  if (way.lobe == surface.lobes.size()) {
    scatter_diffuse(photon, optics, random, way.chance, weight);
    return true;
  }
  if (!(way.chance > 0)) return false;
  const LobeOptics& lobe = surface.lobes[way.lobe];
  const Basis frame(photon.front ? photon.normal : Eigen::Vector3f(-photon.normal));
  const Eigen::Vector3f from = frame.to_local(-photon.direction);
  Eigen::Vector3f to;
  if (from.z() <= 0 || !lobe.lobe->sample(from, static_cast<float>(random.direction_u),
                                          static_cast<float>(random.direction_v), to))
    return false;
  float scale = 1 / way.chance;
  if (!lobe.lobe->is_delta()) {
    const float density = lobe.lobe->pdf(from, to);
    if (!(density > 0)) return false;
    scale *= std::abs(to.z()) / density;
    if (lobe.factor != no_factor) scale *= lobe.lobe->shape(from, to);
  }
  if (lobe.factor != no_factor) {
    multiply_weights(weight, optics.factor(lobe.factor), scale, optics.width);
  } else {
    std::vector<float> values(optics.width, 0.0f);
    lobe.lobe->values(from, to, {values.data(), optics.bands});
    multiply_weights(weight, values.data(), scale, optics.width);
  }
  if (lobe.lobe->is_straight()) return true;
  photon.direction = frame.to_world(to).normalized();
  photon.scattered = true;
  return true;
}

bool within(const Eigen::Vector3f& point, const Extent& extent) {
  const Eigen::Array2d at = point.head<2>().cast<double>().array();
  const double hair = 1e-6 * (extent.low_m.cwiseAbs().maxCoeff() + extent.high_m.cwiseAbs().maxCoeff());
  return (at >= extent.low_m.array() - hair).all() && (at <= extent.high_m.array() + hair).all();
}

Exit exit_of(const Photon& photon, Escape escape, const Extent& extent, bool periodic) {
  if (escape == Escape::wrap_limit) return Exit::wraps;
  const Exit straight = escape == Escape::top ? Exit::top : Exit::bottom;
  if (periodic) return straight;
  const double dz = static_cast<double>(photon.direction.z());
  const double height = straight == Exit::top ? extent.top_m : extent.bottom_m;
  const double length = (height - static_cast<double>(photon.position.z())) / dz;
  if (!std::isfinite(length)) return Exit::side;
  const Eigen::Vector3f at = photon.position + static_cast<float>(std::max(0.0, length)) * photon.direction;
  return within(at, extent) ? straight : Exit::side;
}

}  // namespace bpms
