#include "simulate/forward/flux_rows.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace bpms {

FluxRows::FluxRows(const PhotonStage& stage, const FluxOptions& options)
    : scene_(&stage.simulation->scene),
      extent_(stage.extent),
      edges_m_(options.layers_m),
      map_px_(options.map_px) {
  const auto add = [&](Flux flux, std::string of = {}, std::size_t index = 0, std::size_t prototype = 0) {
    rows_.push_back(
        {flux, std::move(of), static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(prototype)});
  };
  for (std::size_t whole = 0; whole <= static_cast<std::size_t>(Flux::absorbed_ground); ++whole)
    add(static_cast<Flux>(whole));
  first_material_ = rows_.size();
  for (std::size_t m = 0; m < stage.simulation->materials.size(); ++m)
    add(Flux::absorbed_material, stage.simulation->materials[m].name, m);
  for (std::size_t p = 0; p < scene_->prototypes.size(); ++p) {
    const Prototype& prototype = scene_->prototypes[p];
    const bool has = options.organs && prototype.mesh && !prototype.mesh->organs.empty();
    first_organ_.push_back(has ? rows_.size() : none);
    if (!has) continue;
    for (std::size_t o = 0; o < prototype.mesh->organs.size(); ++o)
      add(Flux::absorbed_organ, prototype.name + "/" + prototype.mesh->organs[o].label, o, p);
  }
  if (options.plants) {
    first_plant_ = rows_.size();
    // The parts of a plant are instances of their own; one that nobody counted is a plant by itself.
    std::map<std::pair<std::uint32_t, std::size_t>, std::size_t> known;
    for (std::size_t i = 0; i < scene_->instances.size(); ++i) {
      const Instance& instance = scene_->instances[i];
      const auto key = std::pair(instance.plant, instance.plant == no_plant ? i : std::size_t{0});
      const auto [place, is_new] = known.try_emplace(key, known.size());
      plant_of_instance_.push_back(place->second);
      if (is_new)
        add(Flux::absorbed_plant,
            fmt::format("{} {}", scene_->prototypes[instance.prototype].name, place->second + 1),
            place->second, instance.prototype);
    }
  }
  if (options.layers > 0)
    for (int k = 0; k <= options.layers; ++k)
      edges_m_.push_back(extent_.bottom_m + (extent_.top_m - extent_.bottom_m) * k / options.layers);
  if (!edges_m_.empty()) {
    first_layer_ = rows_.size();
    for (std::size_t k = 0; k + 1 < edges_m_.size(); ++k)
      add(Flux::absorbed_layer, fmt::format("{:.4g}-{:.4g} m", edges_m_[k], edges_m_[k + 1]), k);
  }
  if (map_px_[0] > 0 && map_px_[1] > 0) {
    first_pixel_ = rows_.size();
    const std::size_t count = static_cast<std::size_t>(map_px_[0]) * static_cast<std::size_t>(map_px_[1]);
    for (std::size_t i = 0; i < count; ++i) add(Flux::ground_irradiance, {}, i);
  }
}

std::size_t FluxRows::organ(const Photon& photon) const {
  const std::uint32_t p = scene_->instances[photon.surface.instance].prototype;
  if (first_organ_[p] == none || photon.organ >= scene_->prototypes[p].mesh->organs.size()) return none;
  return first_organ_[p] + photon.organ;
}

std::size_t FluxRows::plant(const Photon& photon) const {
  return first_plant_ == none ? none : first_plant_ + plant_of_instance_[photon.surface.instance];
}

std::size_t FluxRows::layer(const Photon& photon) const {
  if (first_layer_ == none) return none;
  // Rounding at the scene's own ends must not lose light.
  const double hair = 1e-6 * (std::abs(edges_m_.front()) + std::abs(edges_m_.back()));
  const auto z = static_cast<double>(photon.position.z());
  if (z < edges_m_.front() - hair || z > edges_m_.back() + hair) return none;
  const auto above = std::upper_bound(edges_m_.begin() + 1, edges_m_.end() - 1, z);
  return first_layer_ + static_cast<std::size_t>(above - edges_m_.begin()) - 1;
}

std::size_t FluxRows::pixel(const Photon& photon) const {
  if (first_pixel_ == none) return none;
  const Eigen::Vector2d size = extent_.high_m - extent_.low_m;
  const auto cell = [&](int axis, int count) {
    const double part = (static_cast<double>(photon.position[axis]) - extent_.low_m[axis]) / size[axis];
    return std::clamp(static_cast<int>(std::floor(part * count)), 0, count - 1);
  };
  const int column = cell(0, map_px_[0]), row = map_px_[1] - 1 - cell(1, map_px_[1]);
  return first_pixel_ + static_cast<std::size_t>(row) * static_cast<std::size_t>(map_px_[0]) +
         static_cast<std::size_t>(column);
}

void FluxTally::add(std::size_t row, const float* weight) {
  if (row == FluxRows::none) return;
  const std::size_t width = stage_->optics.width;
  double* to = sums_.data() + row * width;
  for (std::size_t b = 0; b < width; b += 8)
    for (std::size_t i = b; i < b + 8; ++i) to[i] += static_cast<double>(weight[i]);
}

void FluxTally::arrive(const Photon& photon, const float* weight, int) {
  if (!photon.ground || !photon.front) return;
  add(rows_->of(Flux::transmitted), weight);
  if (!photon.grounded) add(rows_->of(Flux::transmitted_first), weight);
  if (!photon.scattered) add(rows_->of(Flux::transmitted_direct), weight);
  add(rows_->pixel(photon), weight);
}

void FluxTally::absorb(const Photon& photon, const float* weight) {
  add(rows_->material(photon.material), weight);
  add(rows_->of(photon.ground ? Flux::absorbed_ground : Flux::absorbed_canopy), weight);
  if (photon.ground) return;
  add(rows_->organ(photon), weight);
  add(rows_->plant(photon), weight);
  add(rows_->layer(photon), weight);
}

void FluxTally::leave(const Photon& photon, const float* weight, int, Exit exit) {
  switch (exit) {
    case Exit::top:
      return add(rows_->of(Flux::reflected), weight);
    case Exit::side:
      return add(rows_->of(Flux::lost_sides), weight);
    case Exit::wraps:
      return add(rows_->of(Flux::lost_wraps), weight);
    case Exit::bottom:
      add(rows_->of(Flux::transmitted), weight);
      if (!photon.grounded) add(rows_->of(Flux::transmitted_first), weight);
      if (!photon.scattered) add(rows_->of(Flux::transmitted_direct), weight);
      return;
  }
}

}  // namespace bpms
