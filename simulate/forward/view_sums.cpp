#include "simulate/forward/view_sums.h"

#include <cmath>
#include <numbers>

#include "simulate/transport/estimate.h"

namespace bpms {
namespace {

constexpr float one_over_pi = std::numbers::inv_pi_v<float>;
constexpr std::size_t look_ahead = 8;  // vertices whose squares of the grid are asked for before their turn

// In [0, 1), by the vertex and the view (splitmix64's finaliser).
float chance_number(const PathVertex& v, std::size_t view) {
  std::uint64_t x =
      (std::uint64_t{v.sample} << 32 | std::uint64_t{v.batch} << 16 | std::uint64_t{v.order} << 8 | v.sky) +
      0x9e3779b97f4a7c15ull * (view + 1);
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ x >> 27) * 0x94d049bb133111ebull;
  return static_cast<float>((x ^ x >> 31) >> 40) * 0x1p-24f;
}

}  // namespace

ViewSums::ViewSums(const PhotonStage& stage, const Sensor& sensor, std::size_t view, int orders)
    : stage_(&stage),
      sensor_(&sensor),
      view_(view),
      orders_(orders),
      rows_(2 * static_cast<std::size_t>(orders) + 2),
      towards_(sensor.parallel(view)->cast<float>()),
      sums_(batches * rows_ * stage.optics.bands, 0.0),
      counts_(batches),
      ray_groups_(batches * groups * stage.optics.bands, 0.0),
      photon_groups_(ray_groups_),
      of_sun_(stage.optics.bands, 0.0),
      of_sky_(of_sun_) {
  const Light& light = stage.simulation->light;
  if (light.sun) of_sun_ = light.sun->irradiance;
  if (light.sky) of_sky_ = light.sky->radiance;
  for (ViewCounts& counts : counts_) {
    counts.sunlit.resize(stage.simulation->materials.size());
    counts.shaded.resize(stage.simulation->materials.size());
  }
}

void ViewSums::add_rays(const ViewKey& key, const ParallelRays* view_rays, const ParallelRays* sun_rays,
                        std::uint64_t last) {
  const PhotonOptics& optics = stage_->optics;
  const std::optional<Sun>& sun = stage_->simulation->light.sun;
  const Eigen::Vector3f to_sun = sun ? sun->direction.cast<float>().eval() : Eigen::Vector3f::UnitZ();
  struct Start {
    Ray ray;
    std::uint32_t batch, group;
  };
  std::vector<Start> starts;
  std::vector<std::uint64_t> order, spare;
  constexpr std::uint64_t together = 4096;  // of each batch: neighbours read the same squares
  for (std::uint64_t first = rays_; first < last; first += together) {
    starts.clear(), order.clear();
    for (std::size_t batch = 0; batch < batches; ++batch) {
      PathNumbers numbers(key, static_cast<std::uint32_t>(batch));
      for (std::uint64_t sample = first; sample < std::min(last, first + together); ++sample) {
        numbers.start(sample);
        const auto [u, v] = numbers.position();
        order.push_back(std::uint64_t{place_on_curve({static_cast<float>(u), static_cast<float>(v), 0.0f},
                                                     {{0, 0}, {1, 1}, 1, 0})}
                            << 32 |
                        starts.size());
        starts.push_back({sensor_->start(view_, u, v, stage_->extent), static_cast<std::uint32_t>(batch),
                          static_cast<std::uint32_t>(batch * groups + sample % groups)});
      }
    }
    sort_places(order, spare);
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (view_rays != nullptr && i + look_ahead < order.size())
        view_rays->prefetch(starts[order[i + look_ahead] & 0xffffffffu].ray.origin);
      const Start& start = starts[order[i] & 0xffffffffu];
      ViewCounts& counts = counts_[start.batch];
      ++counts.paths, ++counts.rays;
      Hit hit;
      const bool met = view_rays != nullptr ? view_rays->first(start.ray.origin, hit)
                                            : stage_->intersector->intersect(start.ray, hit) == Escape::hit;
      if (!met || hit.ground) ++counts.gap;
      if (!met) continue;
      const float cosine = hit.geometric_normal.dot(to_sun);
      const bool same_side = (cosine > 0) == hit.front;
      bool lit = sun && (same_side || !optics.opaque(hit.material));
      if (lit) {
        ++counts.rays;
        lit = !(sun_rays != nullptr ? sun_rays->occluded(hit.position, hit.id)
                                    : stage_->intersector->occluded({hit.position, to_sun, 1e30f, hit.id,
                                                                     hit.geometric_normal, hit.extent}));
      }
      ++(lit ? counts.sunlit : counts.shaded)[hit.material];
      if (!lit) continue;
      const float* factor = optics.factor(same_side ? reflectance_factor(hit.material, hit.front)
                                                    : transmittance_factor(hit.material));
      double* one = sum(start.batch, BatchMeans::sun(1));
      double* ground = sum(start.batch, BatchMeans::ground_single);
      for (std::size_t b = 0; b < optics.bands; ++b) {
        const auto value = static_cast<double>(factor[b] * std::abs(cosine) * one_over_pi);
        one[b] += value;
        ray_groups_[start.group * optics.bands + b] += value * of_sun_[b];
        if (hit.ground) ground[b] += value;
      }
    }
  }
  rays_ = std::max(rays_, last);
}

// A vertex sends weight x factor / pi x |cos| into the unit of solid angle; on the horizontal, that is a
// radiance of 1 / mu times it. Rows are per unit of the sun's normal irradiance, or of the sky's radiance.
void ViewSums::add_vertices(const PathVertices& vertices, const ParallelRays* view_rays, std::uint64_t last) {
  const PhotonOptics& optics = stage_->optics;
  const std::optional<Sun>& sun = stage_->simulation->light.sun;
  const float mu = towards_.z();
  const float scale[2] = {sun ? static_cast<float>(sun->direction.z()) * one_over_pi / mu : 0.0f, 1.0f / mu};
  const std::vector<PathVertex>& list = vertices.list;
  // Least variance x work on HET01: 0.6; 0 (look at all), 0.3 and 0.9 are a few per cent worse.
  constexpr float part_of_strongest = 0.6f;
  const float always_above = 1.0f / (part_of_strongest * std::max(1e-6f, optics.largest_factor()));
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (view_rays != nullptr && i + look_ahead < list.size())
      view_rays->prefetch(list[i + look_ahead].position);
    const PathVertex& v = list[i];
    if (v.sample < photons_ || v.sample >= last) continue;
    const float cosine = v.normal.dot(towards_);
    const bool front = v.front != 0, same_side = (cosine > 0) == front;
    if (!same_side && optics.opaque(v.material)) continue;
    const float* factor =
        optics.factor(same_side ? reflectance_factor(v.material, front) : transmittance_factor(v.material));
    const float* weight = vertices.weights.data() + i * optics.bands;
    float geometry = std::abs(cosine) * scale[v.sky];
    // What would add little is looked at less often, and then counts for more.
    float strength = 0;
    for (std::size_t b = 0; b < optics.bands; ++b) strength = std::max(strength, weight[b] * factor[b]);
    const float chance = strength * std::abs(cosine) * always_above;
    if (chance < 1.0f) {
      if (chance_number(v, view_) >= chance) continue;
      geometry /= chance;
    }
    ViewCounts& counts = counts_[v.batch];
    ++counts.rays;
    if (view_rays != nullptr ? view_rays->occluded(v.position, v.surface())
                             : stage_->intersector->occluded({v.position, towards_, 1e30f, v.surface()}))
      continue;
    double* to = sum(v.batch, v.sky != 0 ? BatchMeans::sky(v.order) : BatchMeans::sun(v.order));
    double* group = photon_groups_.data() + (v.batch * groups + v.sample % groups) * optics.bands;
    const std::vector<double>& unit = v.sky != 0 ? of_sky_ : of_sun_;
    for (std::size_t b = 0; b < optics.bands; ++b) {
      const auto value = static_cast<double>(weight[b] * factor[b] * geometry);
      to[b] += value;
      group[b] += value * unit[b];
    }
  }
}

BatchMeans ViewSums::means(std::size_t batch) const {
  BatchMeans out;
  out.bands = stage_->optics.bands;
  out.orders = orders_;
  out.mean.assign(out.rows() * out.bands, 0.0);
  for (std::size_t row = 0; row < rows_; ++row) {
    const bool by_rays = row == BatchMeans::sun(1) || row == BatchMeans::ground_single;
    const auto of = static_cast<double>(std::max<std::uint64_t>(1, by_rays ? rays_ : photons_));
    for (std::size_t b = 0; b < out.bands; ++b) out.row(row)[b] = sum(batch, row)[b] / of;
  }
  return out;
}

ViewSums::Variances ViewSums::variances() const {
  const std::size_t bands = stage_->optics.bands;
  const Light& light = stage_->simulation->light;
  Moments by_rays(bands), by_photons(bands), all(bands);
  for (std::size_t batch = 0; batch < batches; ++batch) {
    const BatchMeans mean = means(batch);
    std::vector<double> value(bands), first(bands, 0.0);
    part_of_batch({}, mean, light, value);
    for (std::size_t b = 0; b < bands; ++b) {
      first[b] = light.sun ? light.sun->irradiance[b] * mean.row(BatchMeans::sun(1))[b] : 0.0;
      by_rays.add(b, first[b], batch);
      by_photons.add(b, value[b] - first[b], batch);
      all.add(b, value[b], batch);
    }
  }
  Variances out;
  // Of one sample, from groups of so many; where the points' evenness pays, the batches show it.
  const auto of_one = [&](const std::vector<double>& sums, std::uint64_t done, std::size_t b,
                          double batch_error) {
    const double each = static_cast<double>(done) / static_cast<double>(groups);
    Moments moments(1);
    for (std::size_t g = 0; g < batches * groups; ++g) moments.add(0, sums[g * bands + b] / each, g);
    const double error = moments.standard_error(0, batches * groups);
    constexpr double noise = 1.25;
    return std::min(error * error, noise * batch_error * batch_error) * static_cast<double>(done * batches);
  };
  for (std::size_t b = 0; b < bands; ++b) {
    out.ray.push_back(of_one(ray_groups_, rays_, b, by_rays.standard_error(b, batches)));
    out.photon.push_back(of_one(photon_groups_, photons_, b, by_photons.standard_error(b, batches)));
    out.standard_error.push_back(all.standard_error(b, batches));
    out.value.push_back(all.mean(b));
  }
  return out;
}

}  // namespace bpms
