#include "simulate/forward/photon_source.h"

#include <cmath>

#include "core/error.h"
#include "core/units.h"
#include "simulate/transport/basis.h"

namespace bpms {
namespace {

// Inward, of the faces: top, low x, high x, low y, high y.
const std::array<Eigen::Vector3d, 5> inward{-Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(),
                                            -Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(),
                                            -Eigen::Vector3d::UnitY()};

}  // namespace

void PhotonSource::place(const Extent& extent, bool periodic) {
  low_ << extent.low_m, extent.bottom_m;
  high_ << extent.high_m, extent.top_m;
  margin_m_ = 1e-4 * (1.0 + std::abs(extent.top_m));
  const Eigen::Vector3d size = high_ - low_;
  std::array<double, 5> power{};  // over that of a horizontal square metre
  for (std::size_t face = 0; face < 5; ++face) {
    if (periodic && face > 0) break;
    const double area = face == 0  ? size.x() * size.y()
                        : face < 3 ? size.y() * size.z()
                                   : size.x() * size.z();
    // A vertical face sees half of an isotropic sky.
    const double each = is_sun      ? std::max(0.0, -inward[face].dot(towards)) / towards.z()
                        : face == 0 ? 1.0
                                    : 0.5;
    power[face] = area * each;
    entering_m2 += power[face];
  }
  if (!(entering_m2 > 0))
    throw Error(ErrorKind::bad_input,
                "the scene has no extent for light to enter: give [domain] size_m, or geometry");
  double sum = 0;
  for (std::size_t face = 0; face < 5; ++face) upto_[face] = (sum += power[face]) / entering_m2;
  upto_[4] = 1;
}

PhotonSource::Start PhotonSource::start(const std::array<double, 4>& numbers, float* weight) const {
  double u = numbers[0];
  std::size_t face = 0;
  while (face < 4 && u >= upto_[face]) ++face;
  const double before = face == 0 ? 0.0 : upto_[face - 1];
  u = std::min(1.0, (u - before) / (upto_[face] - before));  // the same number, within the face
  const double v = numbers[1];
  const Eigen::Vector3d size = high_ - low_;
  Eigen::Vector3d at;
  if (face == 0)
    at << low_.x() + u * size.x(), low_.y() + v * size.y(), high_.z();
  else if (face < 3)
    at << (face == 1 ? low_.x() : high_.x()), low_.y() + u * size.y(), low_.z() + v * size.z();
  else
    at << low_.x() + u * size.x(), (face == 3 ? low_.y() : high_.y()), low_.z() + v * size.z();
  Eigen::Vector3d direction = -towards;
  if (map_) {
    const Eigen::Vector3f from = map_->sample(static_cast<float>(numbers[2]), static_cast<float>(numbers[3]));
    const float density = map_->pdf(from);
    std::vector<float> radiance(map_->bands());
    map_->radiance(from, radiance);
    for (std::size_t b = 0; b < irradiance.size(); ++b)
      weight[b] *= density > 0 && irradiance[b] > 0
                       ? radiance[b] * from.z() / density / static_cast<float>(irradiance[b])
                       : 0.0f;
    direction = -from.cast<double>();
  } else if (is_sun && cos_radius_ < 1) {  // evenly over the disc, each part weighed by its own cosine
    const double z = 1 - numbers[2] * (1 - cos_radius_), angle = 2 * pi * numbers[3];
    const double radius = std::sqrt(std::max(0.0, 1 - z * z));
    const Eigen::Vector3d from =
        Basis(towards.cast<float>())
            .to_world(Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), z).cast<float>())
            .cast<double>()
            .normalized();
    const auto share = static_cast<float>(std::max(0.0, from.z()) / (towards.z() * 0.5 * (1 + cos_radius_)));
    for (std::size_t b = 0; b < irradiance.size(); ++b) weight[b] *= share;
    direction = -from;
  } else if (!is_sun) {  // cosine about the face's normal; what would come up from below is turned over
    const double radius = std::sqrt(numbers[2]), angle = 2 * pi * numbers[3];
    const double a = radius * std::cos(angle), b = radius * std::sin(angle), c = std::sqrt(1 - numbers[2]);
    if (face == 0)
      direction = {a, b, -c};
    else if (face < 3)
      direction = {c * inward[face].x(), a, -std::abs(b)};
    else
      direction = {a, c * inward[face].y(), -std::abs(b)};
  }
  Start out;
  constexpr double flattest = 1e-6;  // a part of a sun's disc may lie at the horizon: it carries nothing
  out.origin = (at - direction * (margin_m_ / std::max(flattest, direction.dot(inward[face]))))
                   .cast<float>();  // up its line
  out.direction = direction.cast<float>();
  return out;
}

std::vector<PhotonSource> photon_sources(const Simulation& simulation, const Extent& extent) {
  const std::size_t bands = simulation.bands.count();
  const Light& light = simulation.light;
  std::vector<PhotonSource> out;
  const bool periodic = simulation.scene.domain.periodic;
  for (std::size_t s = 0; s < light.suns.size(); ++s) {
    PhotonSource& source = out.emplace_back();
    source.sun = static_cast<int>(s);
    source.irradiance = light.direct_irradiance(bands, source.sun);
    source.towards = light.suns[s].direction;
    source.cos_radius_ = std::cos(light.suns[s].radius);
    if (!periodic && light.suns[s].radius > 0)
      throw Error(ErrorKind::bad_input,
                  "fluxes of an open scene take suns that are directions: expected one without a radius");
  }
  if (light.sky) {
    PhotonSource& source = out.emplace_back();
    source.origin = Origin::diffuse;
    source.is_sun = false;
    source.irradiance = light.diffuse_irradiance(bands);
    source.map_ = light.sky->map;
    if (!periodic && source.map_)
      throw Error(ErrorKind::bad_input, "fluxes of an open scene take a sky that is isotropic");
  }
  for (PhotonSource& source : out) source.place(extent, periodic);
  return out;
}

}  // namespace bpms
