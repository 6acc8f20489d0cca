#include "simulate/transport/wave.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "simulate/materials/bumped_normal.h"
#include "simulate/transport/basis.h"
#include "simulate/transport/interactions.h"
#include "simulate/transport/lane_tally.h"
#include "simulate/transport/sampled_tally.h"
#include "simulate/transport/spectrum_tally.h"

namespace bpms {
namespace {

constexpr float inverse_pi = std::numbers::inv_pi_v<float>;
constexpr std::size_t far_ahead = 20;  // paths: from which on their memory is asked for

// Towards some place of the sun's disc.
Eigen::Vector3f in_disc(const SunOptics& sun, const std::array<double, 2>& random) {
  return even_in_cap(Basis(sun.direction), static_cast<double>(sun.cos_radius), random[0], random[1]);
}

}  // namespace

template <class Tally>
Wave<Tally>::Wave(const Stage& stage, const ParallelRays* view_rays)
    : stage_(stage),
      light_(stage.simulation->light),
      sampling_(stage.simulation->sampling),
      view_rays_(view_rays),
      curve_(stage.extent),
      paths_(std::move(spare().paths)),
      next_(std::move(spare().next)),
      order_(std::move(spare().order)),
      unsorted_(std::move(spare().unsorted)),
      values_(std::max(lanes, stage.optics.bands)),
      sky_values_(values_.size()) {}

template <class Tally>
Wave<Tally>::~Wave() {
  paths_.clear(), next_.clear(), order_.clear();
  spare() = {std::move(paths_), std::move(next_), std::move(order_), std::move(unsorted_)};
}

template <class Tally>
void Wave<Tally>::add(const Sensor& sensor, std::size_t view, const ViewKey& key, std::uint64_t first,
                      std::uint64_t last, std::vector<Tally>& tallies) {
  const std::size_t materials = stage_.optics.surfaces.size();
  const std::optional<Eigen::Vector3d> faces = sensor.faces(view);
  for (std::size_t batch = 0; batch < tallies.size(); ++batch) {
    Tally& tally = tallies[batch];
    tally.counts.resize(light_.suns.size(), materials);
    tally.counts.paths += last - first;
    PathNumbers& numbers = numbers_.emplace_back(key, static_cast<std::uint32_t>(batch));
    const auto slot = static_cast<std::uint32_t>(tallies_.size());
    tallies_.push_back(&tally);
    for (std::uint64_t sample = first; sample < last; ++sample) {
      numbers.start(sample);
      const auto [u, v] = numbers.position();
      SensorNumbers random{u, v};
      if (sensor.uses_aperture()) {
        const auto [s, t] = numbers.aperture();
        random.s = s, random.t = t;
      }
      const Ray ray = sensor.start(view, random, stage_.extent);
      Path& path = paths_.emplace_back();
      path.weight = tally.unit(numbers);
      path.position = ray.origin;
      path.direction = ray.direction;
      path.extent = -1;
      path.density = from_mirror;
      path.batch = slot;
      path.sample = static_cast<std::uint32_t>(sample);
      path.branch = 0;
      if (faces) receive_sun(faces->cast<float>(), ray, path);
    }
  }
}

template <class Tally>
void Wave<Tally>::run() {
  for (std::size_t i = 0; i < paths_.size(); ++i) note(i);
  sort_places(order_, unsorted_);
  for (const std::uint64_t item : order_) next_.push_back(paths_[item & index_of_place]);
  const auto path_at = [this](std::size_t i) -> Path& { return paths_[order_[i] & index_of_place]; };
  for (int order = 0; !next_.empty(); ++order) {
    paths_.swap(next_);
    next_.clear();
    order_.clear();
    meet_all(order);
    if (order == sampling_.max_order && order > 0) {  // only the sky was still to be gathered
      for (const std::uint64_t item : order_) release(paths_[item & index_of_place]);
      break;
    }
    sort_places(order_, unsorted_);
    sun_looks_.clear();
    if (std::all_of(stage_.suns.begin(), stage_.suns.end(), [](const SunOptics& sun) { return sun.rays; }))
      for (const SunOptics& sun : stage_.suns) sun_looks_.emplace_back(*sun.rays, order_.size());
    for (now_ = 0; now_ < order_.size(); ++now_) {
      if (now_ + far_ahead < order_.size()) {
        const auto* coming = reinterpret_cast<const char*>(&path_at(now_ + far_ahead));
        for (std::size_t line = 0; line < sizeof(Path); line += 64) __builtin_prefetch(coming + line);
      }
      go_on(path_at(now_), order);
    }
  }
  paths_.clear();
  order_.clear();
  numbers_.clear();
  tallies_.clear();
}

template <class Tally>
void Wave<Tally>::meet_all(int order) {
  std::optional<LookAhead> looks;
  if (order == 0 && view_rays_ != nullptr) looks.emplace(*view_rays_, paths_.size());
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    const auto look = looks ? &looks->at(i, [this](std::size_t k) { return paths_[k].position; }) : nullptr;
    if (meet(paths_[i], order, look)) note(i);
  }
}

template <class Tally>
void Wave<Tally>::note(std::size_t i) {
  order_.push_back(std::uint64_t{curve_.place(paths_[i].position)} << 32 | i);
}

// What a receiver of irradiance gets from the suns themselves.
template <class Tally>
void Wave<Tally>::receive_sun(const Eigen::Vector3f& normal, const Ray& ray, Path& path) {
  Tally& tally = *tallies_[path.batch];
  for (std::size_t s = 0; s < stage_.suns.size(); ++s) {
    const SunOptics& sun = stage_.suns[s];
    Eigen::Vector3f towards = sun.direction;
    if (sun.radius > 0)
      towards = in_disc(sun, numbers_[path.batch].light(0xffffu, static_cast<std::uint32_t>(s)));
    const float cosine = normal.dot(towards);
    if (cosine <= 0) continue;
    Weight weight = tally.copy(path.weight);
    int order = 0;
    Path here = path;
    here.surface = ray.from;
    if (sees(here, towards, no_grid, weight, order))
      tally.add_sun(s, order, weight, {no_factor, cosine * inverse_pi * sun.weight, nullptr}, false);
    tally.release(weight);
  }
}

// False when it meets nothing; else the path is at what it met.
template <class Tally>
bool Wave<Tally>::meet(Path& path, int order, const ParallelRays::Look* look) {
  Escape end = Escape::bottom;
  Hit hit;
  if (look == nullptr)
    end = stage_.intersector->intersect(
        {path.position, path.direction, 1e30f, path.surface, path.normal, path.extent}, hit);
  else if (view_rays_->first(*look, path.position.z(), hit))
    end = Escape::hit;
  Tally& tally = *tallies_[path.batch];
  ++tally.counts.rays;
  if (order == 0 && (end != Escape::hit || hit.ground)) ++tally.counts.gap;
  if (end == Escape::wrap_limit) ++tally.counts.lost;
  if (end == Escape::top) escape(path, order);
  if (end != Escape::hit) {
    release(path);
    return false;
  }
  path.position = hit.position;
  path.normal = path.shading = hit.geometric_normal;
  if (sampling_.interpolated_normals) path.shading = hit.shading_normal;
  if (!stage_.optics.maps.empty()) bend(path, hit);
  path.surface = hit.id;
  path.extent = hit.extent;
  path.material = material_at(hit);
  path.front = hit.front;
  path.ground = hit.ground;
  return true;
}

// What the surface is made of where it was hit.
template <class Tally>
std::uint32_t Wave<Tally>::material_at(const Hit& hit) const {
  if (stage_.optics.maps.empty()) return hit.material;
  const SurfaceMaps& maps = stage_.optics.maps[hit.material];
  return maps.map != nullptr ? maps.materials[static_cast<std::size_t>(maps.map->nearest(hit.uv))]
                             : hit.material;
}

// Tilts the normal by the slopes of a bump map.
template <class Tally>
void Wave<Tally>::bend(Path& path, const Hit& hit) const {
  const SurfaceMaps& maps = stage_.optics.maps[hit.material];
  if (maps.bump == nullptr) return;
  const Raster::Sloped there = maps.bump->bilinear(hit.uv);
  path.shading = bumped_normal(path.shading, hit.dp_du, hit.dp_dv,
                               maps.bump_m * Eigen::Vector2f(there.per_u, there.per_v));
}

// The radiance of the sky there over its mean, by traced band; null where it is the same everywhere.
template <class Tally>
const float* Wave<Tally>::sky_there(const Eigen::Vector3f& towards) {
  if (!light_.sky->map) return nullptr;
  light_.sky->map->radiance(towards, {sky_values_.data(), stage_.inverse_sky.size()});
  for (std::size_t b = 0; b < stage_.inverse_sky.size(); ++b) sky_values_[b] *= stage_.inverse_sky[b];
  return sky_values_.data();
}

// Light that a path which leaves the scene finds and could not, or not only, ask for on its way.
template <class Tally>
void Wave<Tally>::escape(const Path& path, int order) {
  Tally& tally = *tallies_[path.batch];
  if (light_.sky) {
    Scatter by{no_factor, 1, sky_there(path.direction)};
    if (by.values != nullptr && path.density >= 0)
      by.scale = path.density / (path.density + light_.sky->map->pdf(path.direction));
    tally.add_sky(order, path.weight, by);
  }
  if (path.density >= 0) return;
  for (std::size_t s = 0; s < stage_.suns.size(); ++s) {
    const SunOptics& sun = stage_.suns[s];
    if (sun.radius > 0 && path.direction.dot(sun.direction) >= sun.cos_radius)
      tally.add_sun(s, order, path.weight, {no_factor, sun.radiance, nullptr}, false);
  }
}

// Gathers light where the path is, and sends it, or its branches, on.
template <class Tally>
void Wave<Tally>::go_on(Path& path, int order) {
  if (!interact(path, order)) {
    release(path);
    return;
  }
  const int branches = order == 0 ? sampling_.diffuse_rays : 1;
  if (branches > 1) {
    tallies_[path.batch]->scale(path.weight, 1.0f / static_cast<float>(branches));
    for (int b = 1; b < branches; ++b) {
      Path branch = path;
      branch.weight = tallies_[path.batch]->copy(path.weight);
      branch.branch = static_cast<std::uint8_t>(b);
      if (scatter(branch, order))
        next_.push_back(branch);
      else
        release(branch);
    }
  }
  if (scatter(path, order))
    next_.push_back(path);
  else
    release(path);
}

// Gathers the light that the surface sends to the path's viewer. False when the path ends here.
template <class Tally>
bool Wave<Tally>::interact(Path& path, int order) {
  const std::size_t materials = stage_.optics.surfaces.size();
  ViewCounts& counts = tallies_[path.batch]->counts;
  for (std::size_t s = 0; s < stage_.suns.size(); ++s) {
    bool behind = false;
    const bool lit = gather_sun(path, order, s, behind);
    if (order > 0) continue;
    const std::size_t at = s * materials + path.material;
    ++(lit ? counts.sunlit : counts.shaded)[at];
    if (lit && behind) ++counts.lit_behind[at];
    if (lit && path.ground) ++counts.sunlit_ground[s];
  }
  if (light_.sky && light_.sky->map) gather_sky(path, order);
  return order + 1 != sampling_.max_order || light_.sky;
}

// visit(how much of the light from there goes to the viewer, density with which the path would go there by
// this way)
template <class Tally>
template <class Visit>
void Wave<Tally>::each_way(const Path& path, const Eigen::Vector3f& to_light, Visit visit) {
  const SurfaceOptics& surface = stage_.optics.surfaces[path.material];
  const std::size_t face = path.front ? 0 : 1;
  const bool same_side = (path.normal.dot(to_light) > 0) == path.front;
  const float cosine = path.shading.dot(to_light);
  if ((cosine > 0) != (same_side == path.front)) return;  // the two normals disagree: no light leaks
  const float share = same_side ? surface.reflect_share[face] : 1 - surface.reflect_share[face];
  const float chance = share * surface.diffuse_share[face];
  if (chance > 0) {
    const float lambert = std::abs(cosine) * inverse_pi;
    visit(Scatter{same_side ? reflectance_factor(path.material, path.front)
                            : transmittance_factor(path.material),
                  lambert, nullptr},
          chance * lambert);
  }
  if (surface.diffuse) return;
  const Basis frame(path.front ? path.shading : Eigen::Vector3f(-path.shading));
  const Eigen::Vector3f view = frame.to_local(-path.direction), light = frame.to_local(to_light);
  if (view.z() <= 0) return;
  for (std::size_t k = 0; k < surface.lobes.size(); ++k) {
    const LobeOptics& lobe = surface.lobes[k];
    const float chosen = surface.lobe_share[k][face];
    if (!lobe.on_face[face] || lobe.lobe->is_delta() || !(chosen > 0)) continue;
    Scatter by{lobe.factor, std::abs(cosine), nullptr};
    if (lobe.factor != no_factor) {
      by.scale *= lobe.lobe->shape(view, light);
      if (!(by.scale > 0)) continue;
    } else {
      lobe.lobe->values(view, light, {values_.data(), stage_.optics.bands});
      by.values = values_.data();
    }
    visit(by, chosen * lobe.lobe->pdf(view, light));
  }
}

// Does the path's place see the light there, perhaps through surfaces that let it through? These multiply
// `weight` and add to `order`. `sun`: whose grid of parallel rays may answer.
template <class Tally>
bool Wave<Tally>::sees(const Path& path, const Eigen::Vector3f& towards, std::size_t sun, Weight& weight,
                       int& order) {
  Tally& tally = *tallies_[path.batch];
  ++tally.counts.rays;
  Ray ray{path.position, towards, 1e30f, path.surface, path.normal, path.extent};
  if (!stage_.optics.lets_through) {
    if (sun != no_grid && !sun_looks_.empty()) {
      const ParallelRays::Look& look = sun_looks_[sun].at(
          now_, [this](std::size_t k) { return paths_[order_[k] & index_of_place].position; });
      return !stage_.suns[sun].rays->occluded(look, path.position.z(), path.surface);
    }
    if (sun != no_grid && stage_.suns[sun].rays)
      return !stage_.suns[sun].rays->occluded(path.position, path.surface);
    return !stage_.intersector->occluded(ray);
  }
  constexpr int most = 10000;  // surfaces; a ray that is caught between two ends here
  Hit hit;
  for (int passed = 0; passed < most; ++passed) {
    if (stage_.intersector->intersect(ray, hit) != Escape::hit) return true;
    const SurfaceOptics& surface = stage_.optics.surfaces[material_at(hit)];
    if (!surface.lets_through) return false;
    const std::size_t face = hit.front ? 0 : 1;
    // What goes straight on is a sum of spectra; one alone keeps a monomial.
    std::size_t straight = 0;
    Factor factor = no_factor;
    for (const LobeOptics& lobe : surface.lobes)
      if (lobe.lobe->is_straight() && lobe.on_face[face]) ++straight, factor = lobe.factor;
    if (straight == 1 && !sampling_.attenuate_shadows) {
      tally.scatter(weight, {factor, 1, nullptr});
    } else {
      std::fill(values_.begin(), values_.end(), 0.0f);
      const auto add_spectrum = [&](Factor of) {
        for (std::size_t b = 0; b < stage_.optics.bands; ++b)
          values_[b] += static_cast<float>(stage_.optics.spectra[of][b]);
      };
      for (const LobeOptics& lobe : surface.lobes)
        if (lobe.lobe->is_straight() && lobe.on_face[face]) add_spectrum(lobe.factor);
      if (sampling_.attenuate_shadows) add_spectrum(transmittance_factor(material_at(hit)));
      tally.scatter(weight, {no_factor, 1, values_.data()});
    }
    if (!(weight.guide.largest() > 0)) return false;
    ++order;
    ++tally.counts.rays;
    ray = {hit.position, towards, 1e30f, hit.id, hit.geometric_normal, hit.extent};
  }
  return false;
}

// Is it lit? `behind`: on the face that is not seen.
template <class Tally>
bool Wave<Tally>::gather_sun(const Path& path, int order, std::size_t s, bool& behind) {
  const SunOptics& sun = stage_.suns[s];
  Eigen::Vector3f towards = sun.direction;
  if (sun.radius > 0) {
    numbers_[path.batch].start(path.sample, path.branch);
    towards = in_disc(
        sun, numbers_[path.batch].light(static_cast<std::uint32_t>(order), static_cast<std::uint32_t>(s)));
  }
  behind = (path.normal.dot(towards) > 0) != path.front;
  const SurfaceOptics& surface = stage_.optics.surfaces[path.material];
  if (behind && surface.opaque) return false;
  Tally& tally = *tallies_[path.batch];
  if (!stage_.optics.lets_through) {
    Weight unchanged{};
    int none = 0;
    if (!sees(path, towards, s, unchanged, none)) return false;
    each_way(path, towards, [&](Scatter by, float) {
      by.scale *= sun.weight;
      tally.add_sun(s, order + 1, path.weight, by, path.ground);
    });
    return true;
  }
  Weight weight = tally.copy(path.weight);
  int of_light = order + 1;
  const bool lit = sees(path, towards, s, weight, of_light);
  if (lit)
    each_way(path, towards, [&](Scatter by, float) {
      by.scale *= sun.weight;
      tally.add_sun(s, of_light, weight, by, path.ground);
    });
  tally.release(weight);
  return lit;
}

// Asks for the light of one direction of the sky. The ray that goes on may find the same: each counts by the
// balance of their densities (Veach & Guibas 1995).
template <class Tally>
void Wave<Tally>::gather_sky(const Path& path, int order) {
  numbers_[path.batch].start(path.sample, path.branch);
  const auto random = numbers_[path.batch].light(static_cast<std::uint32_t>(order),
                                                 static_cast<std::uint32_t>(stage_.suns.size()));
  const SkyMap& map = *light_.sky->map;
  const Eigen::Vector3f towards = map.sample(static_cast<float>(random[0]), static_cast<float>(random[1]));
  const float density = map.pdf(towards);
  if (!(density > 0)) return;
  const bool behind = (path.normal.dot(towards) > 0) != path.front;
  if (behind && stage_.optics.surfaces[path.material].opaque) return;
  Tally& tally = *tallies_[path.batch];
  Weight weight = tally.copy(path.weight);
  int of_light = order + 1;
  if (sees(path, towards, no_grid, weight, of_light)) {
    const float* there = sky_there(towards);
    each_way(path, towards, [&](Scatter by, float own) {
      by.scale /= density + own;
      if (by.values != nullptr) {
        for (std::size_t b = 0; b < stage_.optics.bands; ++b) values_[b] *= there[b];
      } else {
        by.values = there;
      }
      tally.add_sky(of_light, weight, by);
    });
  }
  tally.release(weight);
}

// Chooses where the path comes from next and with what weight. False when it ends.
template <class Tally>
bool Wave<Tally>::scatter(Path& path, int order) {
  PathNumbers& numbers = numbers_[path.batch];
  numbers.start(path.sample, path.branch);
  InteractionNumbers random = numbers.interaction(static_cast<std::uint32_t>(order));
  const SurfaceOptics& surface = stage_.optics.surfaces[path.material];
  const std::size_t face = path.front ? 0 : 1;
  if (surface.diffuse) {
    if (!scatter_diffuse(path, random, 1)) return false;
  } else {
    const ChosenWay way = choose_way(surface, face, random.side);
    if (way.lobe == surface.lobes.size()) {
      if (!scatter_diffuse(path, random, way.chance)) return false;
    } else if (!(way.chance > 0) || !scatter_lobe(path, surface.lobes[way.lobe], random, way.chance)) {
      return false;
    }
  }
  const float strength = path.weight.guide.largest();
  if (!(strength > 0)) return false;
  if (sampling_.roulette) {
    // Least variance x cost: a chance to go on in proportion to the weight (Bolin & Meyer 1997, SIGGRAPH), by
    // a factor that was measured on the homogeneous disc canopy: 1 (as absorption would do it) and 2 are
    // worse. The sky is seen by the ray that goes on from the first hit, which is then worth its cost.
    constexpr float factor = 1.6f;
    const float split = static_cast<float>(sampling_.diffuse_rays);  // of which each branch has its part
    const float survival = order == 0 && light_.sky ? 1.0f : factor * split * strength;
    if (random.survival >= static_cast<double>(survival)) return false;
    if (survival < 1.0f) tallies_[path.batch]->scale(path.weight, 1.0f / survival);
  }
  return true;
}

// `chosen`: the chance with which the diffuse part was chosen.
template <class Tally>
bool Wave<Tally>::scatter_diffuse(Path& path, const InteractionNumbers& random, float chosen) {
  const float share = stage_.optics.surfaces[path.material].reflect_share[path.front ? 0 : 1];
  const bool reflect = random.side < static_cast<double>(share);
  const float chance = (reflect ? share : 1.0f - share) * chosen;
  tallies_[path.batch]->scatter(path.weight, {reflect ? reflectance_factor(path.material, path.front)
                                                      : transmittance_factor(path.material),
                                              1.0f / chance, nullptr});
  const Eigen::Vector3f outward = path.front == reflect ? path.shading : Eigen::Vector3f(-path.shading);
  path.direction = cosine_direction(outward, random.direction_u, random.direction_v);
  path.density = chance * inverse_pi * outward.dot(path.direction);
  return !sampling_.interpolated_normals || (path.normal.dot(path.direction) > 0) == (path.front == reflect);
}

template <class Tally>
bool Wave<Tally>::scatter_lobe(Path& path, const LobeOptics& lobe, const InteractionNumbers& random,
                               float chosen) {
  const Basis frame(path.front ? path.shading : Eigen::Vector3f(-path.shading));
  const Eigen::Vector3f view = frame.to_local(-path.direction);
  Eigen::Vector3f light;
  if (view.z() <= 0 || !lobe.lobe->sample(view, static_cast<float>(random.direction_u),
                                          static_cast<float>(random.direction_v), light))
    return false;
  Scatter by{lobe.factor, 1 / chosen, nullptr};
  if (lobe.lobe->is_delta()) {
    path.density = from_mirror;
  } else {
    const float density = lobe.lobe->pdf(view, light);
    if (!(density > 0)) return false;
    path.density = chosen * density;
    by.scale = std::abs(light.z()) / path.density;
    if (lobe.factor != no_factor) by.scale *= lobe.lobe->shape(view, light);
  }
  if (lobe.factor == no_factor) {
    lobe.lobe->values(view, light, {values_.data(), stage_.optics.bands});
    by.values = values_.data();
  }
  tallies_[path.batch]->scatter(path.weight, by);
  if (!lobe.lobe->is_straight()) path.direction = frame.to_world(light).normalized();
  return lobe.lobe->is_straight() || (path.normal.dot(path.direction) > 0) == (path.front == (light.z() > 0));
}

template class Wave<LaneTally>;
template class Wave<InteractionTally>;
template class Wave<SpectrumTally>;
template class Wave<SampledTally>;

}  // namespace bpms
