#include "scene/structure/gap_fraction.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "core/interrupt.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/units.h"
#include "scene/intersect/box.h"
#include "scene/structure/split_scene.h"

namespace bpms {
namespace {

constexpr std::uint32_t batches = 32;
constexpr std::uint32_t first_rays = 64;  // of a batch, where there is a target

std::uint64_t gap_key(std::uint64_t seed, std::uint64_t direction, std::uint64_t batch) {
  const auto words = philox(seed, 0x676170u + direction, batch);
  return static_cast<std::uint64_t>(words[0]) << 32 | words[1];
}

struct Counts {
  std::uint32_t rays = 0, plant = 0, leaves = 0, others = 0;
};

// Rays that start near each other and look the same way meet the same things: in their order along a curve
// through the footprint they find them in the caches.
std::uint32_t interleave(std::uint32_t x) {
  x = (x | x << 8) & 0x00ff00ffu;
  x = (x | x << 4) & 0x0f0f0f0fu;
  x = (x | x << 2) & 0x33333333u;
  return (x | x << 1) & 0x55555555u;
}
std::uint32_t curve_place(double u, double v) {
  constexpr double cells = 65536;
  return interleave(static_cast<std::uint32_t>(u * cells)) | interleave(static_cast<std::uint32_t>(v * cells))
                                                                 << 1;
}

Eigen::Vector3f gap_ray(const GapDirection& of, double u, double v) {
  const double azimuth = of.azimuth + of.width * v;
  double cosine = std::cos(of.zenith);
  if (of.zenith_to > of.zenith) cosine += u * (std::cos(of.zenith_to) - cosine);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  return Eigen::Vector3d(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine).cast<float>();
}

void trace_batch(const GapScene& scene, const GapDirection& direction, std::uint64_t stream,
                 std::uint32_t until, Counts& counts) {
  struct Start {
    std::uint32_t place, index;
  };
  constexpr std::uint32_t at_once = 4096;
  std::vector<Start> order;
  while (counts.rays < until) {
    throw_if_interrupted();
    const std::uint32_t from = counts.rays, to = std::min(until, from + at_once);
    order.clear();
    for (std::uint32_t i = from; i < to; ++i)
      order.push_back({curve_place(sobol_owen(i, 0, stream), sobol_owen(i, 1, stream)), i});
    std::sort(order.begin(), order.end(), [](const Start& a, const Start& b) { return a.place < b.place; });
    for (const Start& start : order) {
      const std::uint32_t i = start.index;
      const Eigen::Vector3f at =
          scene.on_ground(scene.footprint().point(sobol_owen(i, 0, stream), sobol_owen(i, 1, stream)));
      const Eigen::Vector3f way = gap_ray(direction, sobol_owen(i, 3, stream), sobol_owen(i, 2, stream));
      const bool leaf = scene.meets_leaf(at, way), other = scene.meets_other(at, way);
      counts.leaves += !leaf;
      counts.others += !other;
      counts.plant += !leaf && !other;
    }
    counts.rays = to;
  }
}

GapShare share_of(const Counts* of, std::uint32_t Counts::*which) {
  double sum = 0, squares = 0;
  const auto share = [&](std::uint32_t b) { return static_cast<double>(of[b].*which) / of[b].rays; };
  for (std::uint32_t b = 0; b < batches; ++b) sum += share(b);
  const double mean = sum / batches;
  for (std::uint32_t b = 0; b < batches; ++b) squares += std::pow(share(b) - mean, 2);
  const double none_seen = 1.0 / (static_cast<double>(of[0].rays) * batches + 1);
  const bool one_sided = mean <= 0 || mean >= 1;
  return {mean, one_sided ? none_seen : std::sqrt(squares / (batches - 1) / batches)};
}

Gap gap_of(const GapDirection& direction, const Counts* of) {
  return {direction, share_of(of, &Counts::plant), share_of(of, &Counts::leaves),
          share_of(of, &Counts::others), static_cast<std::uint64_t>(of[0].rays) * batches};
}

}  // namespace

double Gap::zenith_deg() const {
  return degrees(0.5 * (direction.zenith + direction.zenith_to));
}

Ground ground_level(const Scene& scene) {
  if (scene.ground) return *scene.ground;
  Box box;
  std::vector<Box> own;
  for (const Prototype& prototype : scene.prototypes) own.push_back(bounds(prototype));
  for (const Instance& instance : scene.instances) box.include(bounds(own[instance.prototype], instance));
  Ground out;
  if (!box.empty()) out.height_m = std::min(0.0, box.low.z());
  return out;
}

GapScene::GapScene(const Scene& scene) : footprint_(scene), level_(ground_level(scene)) {
  const auto make = [&](SceneSurface keep) {
    const Scene part = split_scene(scene, keep);
    return part.instances.empty() && !part.ground ? nullptr : std::make_unique<Intersector>(part);
  };
  leaves_ = make(SceneSurface::leaves);
  others_ = make(SceneSurface::others);
}

bool GapScene::meets_leaf(const Eigen::Vector3f& from, const Eigen::Vector3f& direction) const {
  return leaves_ && leaves_->occluded({from, direction, 1e30f, ground_surface});
}

bool GapScene::meets_other(const Eigen::Vector3f& from, const Eigen::Vector3f& direction) const {
  return others_ && others_->occluded({from, direction, 1e30f, ground_surface});
}

Eigen::Vector3f GapScene::on_ground(const Eigen::Vector2d& at) const {
  // Off terrain by more than its rounding.
  constexpr double hair = 1e-5;
  const double height = level_.height_at(at);
  const double lift = level_.terrain ? hair * (at.cwiseAbs().maxCoeff() + std::abs(height) + 1) : 0;
  return Eigen::Vector3d(at.x(), at.y(), height + lift).cast<float>();
}

std::vector<double> usual_gap_angles_deg() {
  std::vector<double> out;
  for (int angle = 0; angle <= 85; angle += 5) out.push_back(angle);
  out.insert(std::upper_bound(out.begin(), out.end(), 57.5), 57.5);
  return out;
}

std::vector<GapDirection> gap_directions(const std::vector<double>& zenith_deg, int sectors) {
  std::vector<GapDirection> out;
  for (const double zenith : zenith_deg) {
    for (int k = 0; k < sectors; ++k) {
      const double width = 2 * pi / sectors;
      out.push_back({radians(zenith), radians(zenith), width * (k - 0.5), width});
    }
  }
  return out;
}

std::vector<Gap> mean_over_azimuth(const std::vector<Gap>& gaps, int sectors) {
  std::vector<Gap> out;
  const auto each = static_cast<std::size_t>(sectors);
  for (std::size_t from = 0; from + each <= gaps.size(); from += each) {
    Gap mean = gaps[from];
    if (each > 1) {
      mean.direction.azimuth = 0, mean.direction.width = 2 * pi;
      mean.rays = 0;
      for (std::size_t k = from; k < from + each; ++k) mean.rays += gaps[k].rays;
      for (GapShare Gap::*which : {&Gap::plant, &Gap::leaves, &Gap::others}) {
        double p = 0, variance = 0;
        for (std::size_t k = from; k < from + each; ++k) {
          p += (gaps[k].*which).p / sectors;
          variance += std::pow((gaps[k].*which).standard_error / sectors, 2);
        }
        mean.*which = {p, std::sqrt(variance)};
      }
    }
    out.push_back(mean);
  }
  return out;
}

std::vector<Gap> gap_fraction(const GapScene& scene, const std::vector<GapDirection>& directions,
                              const GapOptions& options) {
  const std::uint32_t most = std::bit_ceil(std::max(1u, (options.rays + batches - 1) / batches));
  std::vector<Counts> counts(directions.size() * batches);
  std::vector<std::size_t> open(directions.size());
  std::iota(open.begin(), open.end(), 0u);
  std::uint32_t until = options.target_se > 0 ? std::min(most, first_rays) : most;
  while (!open.empty()) {
    parallel_for(open.size() * batches, [&](std::size_t task) {
      const std::size_t d = open[task / batches], batch = task % batches;
      trace_batch(scene, directions[d], gap_key(options.seed, d, batch), until, counts[d * batches + batch]);
    });
    if (until >= most) break;
    std::erase_if(open, [&](std::size_t d) {
      const Gap gap = gap_of(directions[d], &counts[d * batches]);
      return std::max({gap.plant.standard_error, gap.leaves.standard_error, gap.others.standard_error}) <=
             options.target_se;
    });
    until *= 2;
  }
  std::vector<Gap> out;
  for (std::size_t d = 0; d < directions.size(); ++d)
    out.push_back(gap_of(directions[d], &counts[d * batches]));
  return out;
}

}  // namespace bpms
