#include "simulate/forward/view_sums.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "scene/intersect/look_ahead.h"
#include "simulate/transport/estimate.h"
#include "simulate/transport/places.h"

namespace bpms {
namespace {

constexpr float one_over_pi = std::numbers::inv_pi_v<float>;

// In [0, 1), by the vertex and the view (splitmix64's finaliser).
float chance_number(const PathVertex& v, std::size_t view) {
  std::uint64_t x = (std::uint64_t{v.sample} << 32 | std::uint64_t{v.batch} << 16 |
                     std::uint64_t{v.order} << 8 | v.source) +
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
      rows_{stage.simulation->light.suns.size(), orders},
      towards_(sensor.parallel(view)->cast<float>()),
      sums_(batches * rows_.count() * stage.optics.bands, 0.0),
      counts_(batches),
      ray_groups_(batches * groups * stage.optics.bands, 0.0),
      photon_groups_(ray_groups_) {
  const Light& light = stage.simulation->light;
  for (const Sun& sun : light.suns) {
    cos_radius_.push_back(std::cos(sun.radius));
    frames_.emplace_back(sun.direction.cast<float>());
  }
  for (const PhotonSource& source : stage.sources)
    unit_.push_back(source.is_sun ? light.suns[static_cast<std::size_t>(source.sun)].irradiance
                                  : light.sky->radiance);
  for (ViewCounts& counts : counts_) counts.resize(rows_.suns, stage.simulation->materials.size());
}

void ViewSums::add_rays(const ViewKey& key, const ParallelRays* view_rays,
                        const std::vector<const ParallelRays*>& sun_rays, std::uint64_t last) {
  struct Start {
    Ray ray;
    std::uint32_t batch, group;
    std::uint64_t sample;
  };
  std::vector<Start> starts;
  std::vector<std::uint64_t> order, spare;
  constexpr std::uint64_t together = 4096;  // of each batch: neighbours read the same squares
  const MortonCurve unit_curve({{0, 0}, {1, 1}, 1, 0});
  for (std::uint64_t first = rays_; first < last; first += together) {
    starts.clear(), order.clear();
    for (std::size_t batch = 0; batch < batches; ++batch) {
      PathNumbers numbers(key, static_cast<std::uint32_t>(batch));
      for (std::uint64_t sample = first; sample < std::min(last, first + together); ++sample) {
        numbers.start(sample);
        const auto [u, v] = numbers.position();
        order.push_back(std::uint64_t{unit_curve.place({static_cast<float>(u), static_cast<float>(v), 0.0f})}
                            << 32 |
                        starts.size());
        starts.push_back({sensor_->start(view_, {u, v}, stage_->extent), static_cast<std::uint32_t>(batch),
                          static_cast<std::uint32_t>(batch * groups + sample % groups), sample});
      }
    }
    sort_places(order, spare);
    std::optional<LookAhead> looks;
    if (view_rays != nullptr) looks.emplace(*view_rays, order.size());
    const auto origin = [&](std::size_t k) { return starts[order[k] & index_of_place].ray.origin; };
    for (std::size_t i = 0; i < order.size(); ++i) {
      const Start& start = starts[order[i] & index_of_place];
      ViewCounts& counts = counts_[start.batch];
      ++counts.paths, ++counts.rays;
      Hit hit;
      const bool met = looks ? view_rays->first(looks->at(i, origin), start.ray.origin.z(), hit)
                             : stage_->intersector->intersect(start.ray, hit) == Escape::hit;
      if (!met || hit.ground) ++counts.gap;
      if (!met) continue;
      for (std::size_t sun = 0; sun < rows_.suns; ++sun) {
        Eigen::Vector3f towards = frames_[sun].normal;
        if (cos_radius_[sun] < 1) {
          PathNumbers numbers(key, start.batch);
          numbers.start(start.sample);
          const auto [u, v] = numbers.light(0, static_cast<std::uint32_t>(sun));
          towards = even_in_cap(frames_[sun], cos_radius_[sun], u, v);
        }
        add_sun(start.batch, start.group, sun, towards, sun_rays[sun], hit);
      }
    }
  }
  rays_ = std::max(rays_, last);
}

// The light of order 1 from a first hit.
void ViewSums::add_sun(std::size_t batch, std::size_t group, std::size_t sun, const Eigen::Vector3f& towards,
                       const ParallelRays* rays, const Hit& hit) {
  const PhotonOptics& optics = stage_->optics;
  ViewCounts& counts = counts_[batch];
  const float cosine = hit.geometric_normal.dot(towards);
  const bool same_side = (cosine > 0) == hit.front;
  bool lit = same_side || !optics.opaque(hit.material);
  if (lit) {
    ++counts.rays;
    lit = !(rays != nullptr ? rays->occluded(hit.position, hit.id)
                            : stage_->intersector->occluded(
                                  {hit.position, towards, 1e30f, hit.id, hit.geometric_normal, hit.extent}));
  }
  const std::size_t at = sun * (counts.sunlit.size() / rows_.suns) + hit.material;
  ++(lit ? counts.sunlit : counts.shaded)[at];
  if (!lit) return;
  if (!same_side) ++counts.lit_behind[at];
  if (hit.ground) ++counts.sunlit_ground[sun];
  const float* factor = optics.factor(same_side ? reflectance_factor(hit.material, hit.front)
                                                : transmittance_factor(hit.material));
  // Evenly over the disc, per unit of irradiance on the plane normal to its centre.
  const auto disc = static_cast<float>(2 / (1 + cos_radius_[sun]));
  double* one = sum(batch, rows_.sun(1, sun));
  double* ground = sum(batch, rows_.ground_single(sun));
  for (std::size_t b = 0; b < optics.bands; ++b) {
    const auto value = static_cast<double>(factor[b] * std::abs(cosine) * one_over_pi * disc);
    one[b] += value;
    ray_groups_[group * optics.bands + b] += value * unit_[sun][b];
    if (hit.ground) ground[b] += value;
  }
}

// A vertex sends weight x factor / pi x |cos| into the unit of solid angle; on the horizontal, that is a
// radiance of 1 / mu times it. Rows are per unit of the sun's normal irradiance, or of the sky's radiance.
void ViewSums::add_vertices(const PathVertices& vertices, const ParallelRays* view_rays, std::uint64_t last) {
  const PhotonOptics& optics = stage_->optics;
  const float mu = towards_.z();
  std::vector<float> scale;
  const double cell = (stage_->extent.high_m - stage_->extent.low_m).prod();
  for (const PhotonSource& source : stage_->sources) {
    // A part of a sun's disc may lie below the horizon.
    const auto entering = static_cast<float>(source.entering_m2.front() / cell);
    scale.push_back(entering *
                    (source.is_sun ? static_cast<float>(source.towards.z()) * one_over_pi / mu : 1.0f / mu));
  }
  const std::vector<PathVertex>& list = vertices.list;
  // Least variance x work on HET01: 0.6; 0 (look at all), 0.3 and 0.9 are a few per cent worse.
  constexpr float part_of_strongest = 0.6f;
  const float always_above = 1.0f / (part_of_strongest * std::max(1e-6f, optics.largest_factor()));
  std::optional<LookAhead> looks;
  if (view_rays != nullptr) looks.emplace(*view_rays, list.size());
  const auto position = [&](std::size_t k) { return list[k].position; };
  for (std::size_t i = 0; i < list.size(); ++i) {
    const PathVertex& v = list[i];
    if (v.sample < photons_ || v.sample >= last) continue;
    const float cosine = v.normal.dot(towards_);
    const bool front = v.front != 0, same_side = (cosine > 0) == front;
    if (!same_side && optics.opaque(v.material)) continue;
    const float* factor =
        optics.factor(same_side ? reflectance_factor(v.material, front) : transmittance_factor(v.material));
    const float* weight = vertices.weights.data() + i * optics.bands;
    float geometry = std::abs(cosine) * scale[v.source];
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
    if (looks ? view_rays->occluded(looks->at(i, position), v.position.z(), v.surface())
              : stage_->intersector->occluded({v.position, towards_, 1e30f, v.surface()}))
      continue;
    double* to = sum(v.batch, rows_.sun(v.order, v.source));  // the sky follows the suns
    double* group = photon_groups_.data() + (v.batch * groups + v.sample % groups) * optics.bands;
    const std::vector<double>& unit = unit_[v.source];
    for (std::size_t b = 0; b < optics.bands; ++b) {
      const auto value = static_cast<double>(weight[b] * factor[b] * geometry);
      to[b] += value;
      group[b] += value * unit[b];
    }
  }
}

BatchMeans ViewSums::means(std::size_t batch) const {
  BatchMeans out;
  out.reset(rows_, stage_->optics.bands);
  for (std::size_t row = 0; row < rows_.count(); ++row) {
    const bool by_rays = (row >= rows_.sun(1, 0) && row < rows_.sky(1)) || row >= rows_.ground_single(0);
    const auto of = static_cast<double>(std::max<std::uint64_t>(1, by_rays ? rays_ : photons_));
    for (std::size_t b = 0; b < out.bands; ++b) out.row(row)[b] = sum(batch, row)[b] / of;
  }
  return out;
}

namespace {

// Of one sample, per written band, from sums over so many groups of `each` samples.
std::vector<double> variance_of_one(const std::vector<double>& sums, std::size_t count, double each,
                                    const Bands& bands) {
  const std::size_t traced = sums.size() / count;
  Moments moments(bands.written());
  std::vector<double> mean(traced);
  for (std::size_t g = 0; g < count; ++g) {
    for (std::size_t b = 0; b < traced; ++b) mean[b] = sums[g * traced + b] / each;
    const std::vector<double> value = bands.integrate(mean);
    for (std::size_t b = 0; b < value.size(); ++b) moments.add(b, value[b], g);
  }
  std::vector<double> out;
  for (std::size_t b = 0; b < bands.written(); ++b) {
    const double error = moments.standard_error(b, count);
    out.push_back(error * error * each * static_cast<double>(count));
  }
  return out;
}

// Of batches, where the points' evenness shows; with room for their noise.
std::vector<double> sums_of_batches(const std::vector<double>& groups, std::size_t count) {
  const std::size_t bands = groups.size() / count, each = count / batches;
  std::vector<double> out(batches * bands, 0.0);
  for (std::size_t g = 0; g < count; ++g)
    for (std::size_t b = 0; b < bands; ++b) out[g / each * bands + b] += groups[g * bands + b];
  return out;
}

}  // namespace

ViewSums::Variances ViewSums::variances(const Sources& sources) const {
  const Bands& bands = stage_->simulation->bands;
  Variances out;
  const auto plan = [&](const std::vector<double>& sums, std::uint64_t done) {
    constexpr std::size_t count = batches * groups;
    constexpr double noise = 1.25;
    const auto samples = static_cast<double>(done);
    std::vector<double> fine = variance_of_one(sums, count, samples / static_cast<double>(groups), bands);
    const std::vector<double> coarse = variance_of_one(sums_of_batches(sums, count), batches, samples, bands);
    for (std::size_t b = 0; b < fine.size(); ++b) fine[b] = std::min(fine[b], noise * coarse[b]);
    return fine;
  };
  out.ray = plan(ray_groups_, rays_);
  out.photon = plan(photon_groups_, photons_);
  Moments all(bands.written());
  std::vector<double> value(bands.written());
  for (std::size_t batch = 0; batch < batches; ++batch) {
    part_of_batch({}, means(batch), sources, value);
    for (std::size_t b = 0; b < value.size(); ++b) all.add(b, value[b], batch);
  }
  for (std::size_t b = 0; b < value.size(); ++b) {
    out.standard_error.push_back(all.standard_error(b, batches));
    out.value.push_back(all.mean(b));
  }
  return out;
}

}  // namespace bpms
