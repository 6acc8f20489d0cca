#include "simulate/forward/photon_source.h"

#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/units.h"
#include "simulate/transport/basis.h"

namespace bpms {
namespace {

// Inward, of the faces: top, low x, high x, low y, high y.
const std::array<Eigen::Vector3d, 5> inward{-Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(),
                                            -Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(),
                                            -Eigen::Vector3d::UnitY()};

double sum_of_faces(const std::array<double, 5>& of) {
  return std::accumulate(of.begin(), of.end(), 0.0);
}

// In proportion to `of`; u comes back stretched, to be used again.
std::size_t choose_face(const std::array<double, 5>& of, double& u) {
  const double at = u * sum_of_faces(of);
  double before = 0;
  std::size_t face = 0, last = 0;
  for (; face < of.size(); ++face) {
    if (!(of[face] > 0)) continue;
    last = face;
    if (at < before + of[face]) break;
    before += of[face];
  }
  if (face == of.size()) {  // rounding, or nothing is seen at all
    u = 1;
    return last;
  }
  u = std::min(1.0, (at - before) / of[face]);
  return face;
}

}  // namespace

PhotonSource::Faces PhotonSource::seen_from(const Eigen::Vector3d& from) const {
  Faces out{};
  for (std::size_t face = 0; face < faces && from.z() > 0; ++face)
    out[face] = area_[face] * std::max(0.0, -inward[face].dot(from));
  return out;
}

double PhotonSource::mean_over_disc() const {
  constexpr int rings = 64, steps = 64;
  const Basis frame(towards.cast<float>());
  double sum = 0;
  for (int ring = 0; ring < rings; ++ring)
    for (int step = 0; step < steps; ++step)
      sum += sum_of_faces(seen_from(
          even_in_cap(frame, cos_radius_, (ring + 0.5) / rings, (step + 0.5) / steps).cast<double>()));
  return sum / (rings * steps);
}

// The sides' part of the map's power, by the midpoint rule over parts of its cells.
void PhotonSource::integrate_map() {
  const auto parts = [](std::size_t cells, std::size_t least) {
    constexpr std::size_t of_a_cell = 4;
    return cells * std::max(of_a_cell, (least + cells - 1) / cells);
  };
  const std::size_t rings = parts(map_->zeniths() - 1, 128), steps = parts(map_->azimuths(), 256);
  const double ring_rad = 0.5 * pi / static_cast<double>(rings),
               step_rad = 2 * pi / static_cast<double>(steps);
  std::vector<float> radiance(map_->bands());
  for (std::size_t ring = 0; ring < rings; ++ring)
    for (std::size_t step = 0; step < steps; ++step) {
      const double zenith = (static_cast<double>(ring) + 0.5) * ring_rad,
                   azimuth = (static_cast<double>(step) + 0.5) * step_rad;
      const Eigen::Vector3d from(std::sin(zenith) * std::sin(azimuth), std::sin(zenith) * std::cos(azimuth),
                                 std::cos(zenith));
      Faces seen = seen_from(from);
      seen[0] = 0;  // the top: the irradiance on the horizontal, which the map knows
      const double weight = sum_of_faces(seen) * std::sin(zenith) * ring_rad * step_rad;
      map_->radiance(from.cast<float>(), radiance);
      for (std::size_t b = 0; b < irradiance.size(); ++b)
        if (irradiance[b] > 0) entering_m2[b] += weight * static_cast<double>(radiance[b]) / irradiance[b];
    }
}

void PhotonSource::place(const Extent& extent, bool periodic) {
  low_ << extent.low_m, extent.bottom_m;
  high_ << extent.high_m, extent.top_m;
  margin_m_ = 1e-4 * (1.0 + std::abs(extent.top_m));
  const Eigen::Vector3d size = high_ - low_;
  area_ = {size.x() * size.y(), 0, 0, 0, 0};
  if (!periodic)
    for (std::size_t face = 1; face < faces; ++face)
      area_[face] = (face < 3 ? size.y() : size.x()) * size.z();
  constexpr double side_of_sky = 0.5;  // a vertical face sees half of an isotropic sky
  for (std::size_t face = 0; face < faces; ++face) even_[face] = area_[face] * (face == 0 ? 1 : side_of_sky);
  even_m2_ = sum_of_faces(even_);
  centre_ = seen_from(towards);
  double entering = even_m2_;
  if (is_sun && cos_radius_ < 1) {
    disc_m2_ = mean_over_disc();
    entering = disc_m2_ * 2 / ((1 + cos_radius_) * towards.z());
  } else if (is_sun) {
    entering = sum_of_faces(centre_) / towards.z();
  } else if (map_) {
    entering = area_[0];
  }
  entering_m2.assign(irradiance.size(), entering);
  // As the map is bright, times the cosine: towards the horizon that leaves the sides too little.
  constexpr double half = 0.5;
  if (map_ && !periodic) {
    by_map_ = half;
    integrate_map();
  }
  if (!(even_m2_ > 0))
    throw Error(ErrorKind::bad_input,
                "the scene has no extent for light to enter: give [domain] size_m, or geometry");
}

// Of an isotropic sky through this face, towards the sky: cosine about the face's normal; what would come up
// from below is turned over.
Eigen::Vector3d PhotonSource::draw_even(std::size_t face, double u, double v) const {
  const double radius = std::sqrt(u), angle = 2 * pi * v;
  const double a = radius * std::cos(angle), b = radius * std::sin(angle), c = std::sqrt(1 - u);
  if (face == 0) return {-a, -b, c};
  if (face < 3) return {-c * inward[face].x(), -a, std::abs(b)};
  return {-a, -c * inward[face].y(), std::abs(b)};
}

// By the density with which both ways of drawing together give the direction.
void PhotonSource::weigh_map(const Eigen::Vector3f& from, float* weight) const {
  const double seen = sum_of_faces(seen_from(from.cast<double>()));
  const double density =
      by_map_ * static_cast<double>(map_->pdf(from)) + (1 - by_map_) * seen / (pi * even_m2_);
  std::vector<float> radiance(map_->bands());
  map_->radiance(from, radiance);
  for (std::size_t b = 0; b < irradiance.size(); ++b)
    weight[b] *= density > 0 && irradiance[b] > 0
                     ? radiance[b] * static_cast<float>(seen / (density * irradiance[b] * entering_m2[b]))
                     : 0.0f;
}

PhotonSource::Start PhotonSource::start(const std::array<double, 4>& numbers, float* weight) const {
  double u = numbers[0];
  std::size_t face = 0;
  Eigen::Vector3d from = towards;
  if (map_) {
    const bool even = numbers[2] >= by_map_;
    if (even) {
      face = choose_face(even_, u);
      from = draw_even(face, (numbers[2] - by_map_) / (1 - by_map_), numbers[3]);
    } else {
      from = map_->sample(numbers[2] / by_map_, numbers[3]).cast<double>();
      face = choose_face(seen_from(from), u);
    }
    weigh_map(from.cast<float>(), weight);
  } else if (is_sun && cos_radius_ < 1) {  // evenly over the disc, each part weighed by what it sees
    from = even_in_cap(Basis(towards.cast<float>()), cos_radius_, numbers[2], numbers[3]).cast<double>();
    const Faces seen = seen_from(from);
    face = choose_face(seen, u);
    const auto share = static_cast<float>(sum_of_faces(seen) / disc_m2_);
    for (std::size_t b = 0; b < irradiance.size(); ++b) weight[b] *= share;
  } else if (is_sun) {
    face = choose_face(centre_, u);
  } else {
    face = choose_face(even_, u);
    from = draw_even(face, numbers[2], numbers[3]);
  }
  const double v = numbers[1];
  const Eigen::Vector3d size = high_ - low_;
  Eigen::Vector3d at;
  if (face == 0)
    at << low_.x() + u * size.x(), low_.y() + v * size.y(), high_.z();
  else if (face < 3)
    at << (face == 1 ? low_.x() : high_.x()), low_.y() + u * size.y(), low_.z() + v * size.z();
  else
    at << low_.x() + u * size.x(), (face == 3 ? low_.y() : high_.y()), low_.z() + v * size.z();
  Start out;
  constexpr double flattest = 1e-6;  // a part of a sun's disc may lie at the horizon: it carries nothing
  out.origin =
      (at + from * (margin_m_ / std::max(flattest, -from.dot(inward[face])))).cast<float>();  // up its line
  out.direction = -from.cast<float>();
  return out;
}

std::vector<PhotonSource> photon_sources(const Simulation& simulation, const Extent& extent) {
  const std::size_t bands = simulation.bands.count();
  const Light& light = simulation.light;
  std::vector<PhotonSource> out;
  for (std::size_t s = 0; s < light.suns.size(); ++s) {
    PhotonSource& source = out.emplace_back();
    source.sun = static_cast<int>(s);
    source.irradiance = light.direct_irradiance(bands, source.sun);
    source.towards = light.suns[s].direction;
    source.cos_radius_ = std::cos(light.suns[s].radius);
  }
  if (light.sky) {
    PhotonSource& source = out.emplace_back();
    source.origin = Origin::diffuse;
    source.is_sun = false;
    source.irradiance = light.diffuse_irradiance(bands);
    source.map_ = light.sky->map;
  }
  for (PhotonSource& source : out) source.place(extent, simulation.scene.domain.periodic);
  return out;
}

}  // namespace bpms
