#include "simulate/forward/shared_views.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "core/interrupt.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "simulate/forward/share_plan.h"
#include "simulate/transport/estimate.h"

namespace bpms {
namespace {

using SharedClock = std::chrono::steady_clock;

constexpr std::uint32_t shared_stream = 0xf2f20000u;  // keeps the photons' numbers apart from those of views
constexpr std::uint64_t first_paths = 128;            // a batch
constexpr std::uint64_t most_vertex_bytes = std::uint64_t{1} << 28;
constexpr std::uint64_t most_grid_bytes = std::uint64_t{1} << 30;  // of all views that keep theirs

// The views' grids for rays of one direction, made when they are first asked for. All are kept when there is
// room for all; else each is made again for each use.
class ViewGrids {
 public:
  ViewGrids(const Simulation& simulation, const Intersector& intersector, const Sensor& sensor)
      : simulation_(&simulation), intersector_(&intersector), sensor_(&sensor), kept_(sensor.views()) {
    kept_[0] = make(0);
    suits_ = kept_[0] != nullptr;
    keeps_ = suits_ && kept_[0]->memory_bytes() * sensor.views() <= most_grid_bytes;
  }
  bool keeps() const { return keeps_; }
  bool suits() const { return suits_; }
  std::shared_ptr<const ParallelRays> get(std::size_t view) {  // one thread a view
    if (!suits_) return nullptr;
    if (kept_[view]) return kept_[view];
    std::shared_ptr<const ParallelRays> made = make(view);
    if (keeps_) kept_[view] = made;
    return made;
  }

 private:
  std::shared_ptr<const ParallelRays> make(std::size_t view) const {
    return intersector_->parallel_rays(simulation_->scene, *sensor_->parallel(view));
  }
  const Simulation* simulation_;
  const Intersector* intersector_;
  const Sensor* sensor_;
  std::vector<std::shared_ptr<const ParallelRays>> kept_;
  bool suits_ = false, keeps_ = false;
};

class SharedRun {
 public:
  SharedRun(const Simulation& simulation, const Intersector& intersector, const Sensor& sensor,
            std::uint64_t seed, std::uint32_t sensor_index, int orders)
      : simulation_(&simulation),
        sensor_(&sensor),
        seed_(seed),
        index_(sensor_index),
        orders_(orders),
        stage_(simulation, intersector),
        sources_(simulation),
        grids_(simulation, intersector, sensor) {
    for (const PhotonSource& source : stage_.sources) {
      sun_grids_.push_back(
          !source.has_directions() ? intersector.parallel_rays(simulation.scene, source.towards) : nullptr);
      sun_rays_.push_back(sun_grids_.back().get());
    }
    for (std::size_t view = 0; view < sensor.views(); ++view)
      views_.emplace_back(stage_, sensor, view, orders);
  }

  // To these goals, a chunk of photon paths at a time.
  void advance(const std::vector<ViewGoal>& goals, bool with_grids, Progress& progress) {
    const auto wants_photons = [&](std::size_t v, std::uint64_t upto) {
      return views_[v].photons() < upto && views_[v].photons() < goals[v].photons;
    };
    std::uint64_t done = std::numeric_limits<std::uint64_t>::max(), most = 0;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      if (!wants_photons(v, goals[v].photons)) continue;
      done = std::min(done, views_[v].photons());
      most = std::max(most, goals[v].photons);
    }
    const double bytes =
        vertices_a_path() * static_cast<double>(batches * PathVertices::bytes(stage_.optics.bands));
    const std::uint64_t step =
        std::max<std::uint64_t>(first_paths, static_cast<std::uint64_t>(most_vertex_bytes / bytes));
    bool rays_done = false;
    while (!rays_done || done < most) {
      const std::uint64_t upto = std::min(most, done + step);
      PathVertices vertices;
      if (done < most) {
        vertices = trace_vertices(stage_, sun_rays_, seed_, shared_stream + index_, orders_, done, upto);
        photon_rays_ += vertices.rays;
        vertices_ += vertices.list.size();
        paths_ += (upto - done) * batches;
      }
      parallel_for(views_.size(), [&](std::size_t v) {
        ViewSums& view = views_[v];
        const bool rays = !rays_done && view.rays() < goals[v].rays,
                   photons = done < most && wants_photons(v, upto);
        if (interrupted() || !(rays || photons)) return;
        const std::shared_ptr<const ParallelRays> grid = with_grids ? grids_.get(v) : nullptr;
        if (rays) view.add_rays({seed_, index_, v}, grid.get(), sun_rays_, goals[v].rays);
        if (!photons) return;
        view.add_vertices(vertices, grid.get(), std::min(upto, goals[v].photons));
        view.end_photons(std::min(upto, goals[v].photons));
      });
      progress.add((upto - std::min(done, upto)) * batches);
      rays_done = true;
      done = upto;
      if (interrupted()) return;
    }
  }

  std::vector<ViewGoal> plan() const {
    const double vertices = vertices_a_path();
    const double rays = paths_ > 0 ? static_cast<double>(photon_rays_) / static_cast<double>(paths_) : 1.0;
    // Microseconds, as measured on HET01: through grids, and through the hierarchy.
    const ShareCosts costs = grids_.suits() ? ShareCosts{0.25, 0.06 * vertices, 1.3 * rays}
                                            : ShareCosts{2.0, 1.0 * vertices, 1.3 * rays};
    return plan_views(views_, sources_, costs);
  }

  bool has_grids_at_hand() const { return grids_.keeps(); }
  const std::vector<ViewSums>& views() const { return views_; }
  bool reached(std::size_t view) const {
    return is_reached(views_[view].variances(sources_), simulation_->sampling);
  }

  void finish(SensorResult& result, std::vector<double>& covariance) const {
    const std::size_t bands = simulation_->bands.written(), count = views_.size();
    std::vector<double> totals(batches * count * bands), value(bands);
    for (std::size_t v = 0; v < count; ++v) {
      if (views_[v].rays() == 0) continue;
      std::vector<BatchMeans> means;
      std::vector<const ViewCounts*> counts;
      for (std::size_t batch = 0; batch < batches; ++batch) {
        means.push_back(views_[v].means(batch));
        counts.push_back(&views_[v].counts(batch));
        result.rays += counts.back()->rays;
        part_of_batch({}, means.back(), sources_, value);
        std::copy(value.begin(), value.end(),
                  totals.begin() + static_cast<std::ptrdiff_t>((batch * count + v) * bands));
      }
      write_light(means, sources_, v, result);
      write_fractions(counts, v, result);
      result.samples[v] += views_[v].photons() * batches;
    }
    result.rays += photon_rays_;
    covariance.assign(bands * count * count, 0.0);
    constexpr double per = 1.0 / (static_cast<double>(batches) * (static_cast<double>(batches) - 1));
    for (std::size_t b = 0; b < bands; ++b) {
      for (std::size_t v = 0; v < count; ++v) {
        for (std::size_t w = 0; w <= v; ++w) {
          double sum = 0;
          for (std::size_t batch = 0; batch < batches; ++batch)
            sum += (totals[(batch * count + v) * bands + b] - result.radiance[0].value[v * bands + b]) *
                   (totals[(batch * count + w) * bands + b] - result.radiance[0].value[w * bands + b]);
          covariance[(b * count + v) * count + w] = covariance[(b * count + w) * count + v] = sum * per;
        }
      }
    }
  }

 private:
  double vertices_a_path() const {
    constexpr double unknown = 4;
    return paths_ > 0 ? std::max(0.1, static_cast<double>(vertices_) / static_cast<double>(paths_)) : unknown;
  }
  const Simulation* simulation_;
  const Sensor* sensor_;
  std::uint64_t seed_;
  std::uint32_t index_;
  int orders_;
  PhotonStage stage_;
  Sources sources_;
  ViewGrids grids_;
  std::vector<std::unique_ptr<ParallelRays>> sun_grids_;
  std::vector<const ParallelRays*> sun_rays_;
  std::vector<ViewSums> views_;
  std::uint64_t photon_rays_ = 0, vertices_ = 0, paths_ = 0;
};

}  // namespace

bool can_share_paths(const Simulation& simulation, const Sensor& sensor, std::string* why) {
  const auto no = [&](const char* reason) {
    if (why != nullptr) *why = reason;
    return false;
  };
  constexpr std::size_t most_bands = 64, most_materials = 65536, most_suns = 254;
  if (!simulation.scene.domain.periodic)
    return no("the scene is open, and views look past its box, where no photon starts");
  if (simulation.bands.count() > most_bands) return no("there are more than 64 bands");
  if (simulation.materials.size() > most_materials) return no("there are more than 65 536 materials");
  if (simulation.light.suns.size() > most_suns) return no("there are more than 254 suns");
  if (simulation.bands.sampled) return no("its bands are sampled");
  for (const Material& material : simulation.materials)
    if (!material.is_diffuse()) return no("a material is not diffuse alone");
  const Sampling& sampling = simulation.sampling;
  if (sampling.interpolated_normals) return no("normals are interpolated");
  if (sampling.attenuate_shadows) return no("shadows are attenuated");
  if (sampling.keep_interactions) return no("interactions are kept");
  for (std::size_t view = 0; view < sensor.views(); ++view)
    if (!sensor.parallel(view) || sensor.measures() != Measures::radiance)
      return no("its rays are not parallel");
  return true;
}

SharedViews trace_shared_views(const Simulation& simulation, const Intersector& intersector,
                               const Sensor& sensor, std::uint64_t seed, std::uint32_t sensor_index,
                               SharedClock::time_point deadline) {
  const Sampling& sampling = simulation.sampling;
  constexpr int many_orders = 64, most_orders = 255;
  int orders = std::min(most_orders, sampling.orders > 0 ? sampling.orders : many_orders);
  if (sampling.max_order > 0) orders = std::min(orders, sampling.max_order);
  if (sampling.max_order != 1) orders = std::max(orders, 2);  // order 1 comes another way than the rest
  SharedViews out;
  SensorResult& result = out.result;
  const std::size_t bands = simulation.bands.written(), count = sensor.views(),
                    suns = simulation.light.suns.size();
  result.sensor = &sensor;
  result.parts = parts_of(simulation.light, orders);
  result.radiance.resize(result.parts.size());
  for (Estimates& part : result.radiance) part.resize(count * bands);
  result.gap.resize(count);
  for (Estimates* fractions : {&result.sunlit, &result.shaded, &result.lit_behind})
    fractions->resize(count * suns * simulation.materials.size());
  result.sunlit_ground.resize(count * suns);
  result.samples.assign(count, 0);

  SharedRun run(simulation, intersector, sensor, seed, sensor_index, orders);
  Progress progress("photon paths", 0);
  const std::uint64_t wanted = sampling.samples > 0
                                   ? std::bit_ceil((sampling.samples + batches - 1) / batches)
                                   : std::max<std::uint64_t>(1, sampling.max_samples / batches);
  const SharedClock::time_point start = SharedClock::now();
  std::vector<ViewGoal> goals(count, {std::min(wanted, first_paths), std::min(wanted, first_paths)});
  run.advance(goals, run.has_grids_at_hand(), progress);
  throw_if_interrupted();  // nothing is whole yet
  for (;;) {
    std::vector<ViewGoal> next =
        sampling.samples > 0 ? std::vector<ViewGoal>(count, {wanted, wanted}) : run.plan();
    bool more = false, reached = true;
    double growth = 1;
    for (std::size_t v = 0; v < count; ++v) {
      more = more || next[v].rays > run.views()[v].rays() || next[v].photons > run.views()[v].photons();
      growth =
          std::max({growth, static_cast<double>(next[v].rays) / static_cast<double>(run.views()[v].rays()),
                    static_cast<double>(next[v].photons) / static_cast<double>(run.views()[v].photons())});
      if (sampling.target_se > 0) reached = reached && run.reached(v);
    }
    out.stopped_by = sampling.samples > 0 ? "samples" : reached ? "target_se" : "max_samples";
    if (!more) break;
    // What there is time for, by the pace so far (which includes the making of the grids).
    const auto seconds = [](SharedClock::duration d) { return std::chrono::duration<double>(d).count(); };
    const double affordable = deadline == SharedClock::time_point::max()
                                  ? std::numeric_limits<double>::infinity()
                                  : 1 + std::max(0.0, seconds(deadline - SharedClock::now())) /
                                            std::max(1e-9, seconds(SharedClock::now() - start));
    if (growth > affordable) {
      out.stopped_by = "max_seconds";
      constexpr double worth_a_round = 1.125;
      if (affordable < worth_a_round) break;
      for (std::size_t v = 0; v < count; ++v) {
        const auto most = [&](std::uint64_t now) {
          return static_cast<std::uint64_t>(affordable * static_cast<double>(now));
        };
        next[v].rays = std::min(next[v].rays, most(run.views()[v].rays()));
        next[v].photons = std::min(next[v].photons, most(run.views()[v].photons()));
      }
    }
    run.advance(next, true, progress);
    if (interrupted()) {
      out.stopped_by = "interrupt";
      break;
    }
  }
  run.finish(result, out.covariance);
  drop_empty_orders(result);
  write_truncation(sampling, bands, result);
  return out;
}

}  // namespace bpms
