// Rays per second of the intersector over those of bare Embree on the same rays and the same discs, one and
// two threads, and seconds and MiB to build. Bare Embree has no period, no ground and no hit record: both
// trace rays that start in the cell; the bare scene holds what the intersector holds (3 x 3 copies would only
// make it slower).
//   bench_intersector [DATA_FOLDER]
#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <thread>
#include <vector>

#include "core/random.h"
#include "core/text.h"
#include "core/units.h"
#include "scene/importers/disc_list.h"
#include "scene/intersect/embree.h"
#include "scene/intersect/intersector.h"

namespace {

using namespace bpms;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Discs that stand nowhere yet, above a ground.
Scene discs_over_ground(double size_m, const std::string& file) {
  Scene scene;
  scene.domain.size_m = {size_m, size_m};
  scene.materials = {"leaf", "soil"};
  scene.prototypes.emplace_back().discs = read_disc_list(file);
  scene.ground = Ground{0, 1};
  return scene;
}

Scene het01(const std::string& data) {
  Scene scene = discs_over_ground(100, data + "/rami/het01/het01_UNI_sphere.def");
  for (const auto& row : read_number_table(data + "/rami/het01/het01_UNI_instances.def", 3, 3, "x y z").rows)
    scene.instances.emplace_back().position_m = {row[0], row[1], row[2]};
  return scene;
}

Scene bench_hom(const std::string& data) {
  Scene scene = discs_over_ground(25, data + "/bench_hom/hom_discs.def.gz");
  scene.instances.emplace_back();
  return scene;
}

// The same discs written out into one BVH, with nothing around it.
struct Bare {
  explicit Bare(const Scene& scene) : bvh(device) {
    std::size_t count = 0;
    for (const Instance& i : scene.instances) count += scene.prototypes[i.prototype].discs.size();
    RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT);
    auto* vertex = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, count));
    auto* normal = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_NORMAL, 0, RTC_FORMAT_FLOAT3, 12, count));
    for (const Instance& i : scene.instances) {
      for (const Disc& d : scene.prototypes[i.prototype].discs) {
        const Eigen::Vector3f c = d.centre_m + i.position_m.cast<float>();
        for (int k = 0; k < 3; ++k) *vertex++ = c[k], *normal++ = d.normal[k];
        *vertex++ = d.radius_m;
      }
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(bvh.get(), geometry);
    rtcReleaseGeometry(geometry);
    bvh.commit();
  }
  embree::Device device;
  embree::Bvh bvh;
};

enum class Kind { primary, secondary, sun };

// Rays as a path tracer makes them: parallel primaries from the top in raster order, cosine-distributed ones
// from surfaces, and shadow rays to the sun from surfaces.
std::vector<Ray> make_rays(const Scene& scene, const Intersector& intersector, Kind kind, std::size_t count) {
  Philox random(7, static_cast<std::uint64_t>(kind));
  const Eigen::Vector3d view = direction_from_angles(radians(30), radians(40), scene.domain);
  const Eigen::Vector3f sun = direction_from_angles(radians(20), 0, scene.domain).cast<float>();
  const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(count)));
  std::vector<Ray> out;
  for (std::size_t i = 0; out.size() < count; ++i) {
    const double u = kind == Kind::primary ? (static_cast<double>(i % side) + 0.5) / static_cast<double>(side)
                                           : random.uniform();
    const double v = kind == Kind::primary
                         ? (static_cast<double>(i / side % side) + 0.5) / static_cast<double>(side)
                         : random.uniform();
    const Eigen::Vector2d size = scene.domain.size_m;
    const Eigen::Vector3f origin(static_cast<float>((u - 0.5) * size.x()),
                                 static_cast<float>((v - 0.5) * size.y()), intersector.top_m());
    const Ray primary{origin, -view.cast<float>(), 1e30f, {}};
    if (kind == Kind::primary) {
      out.push_back(primary);
      continue;
    }
    Hit hit;
    if (intersector.intersect(primary, hit) != Escape::hit) continue;
    Ray next{hit.position, sun, 1e30f, hit.id};
    if (kind == Kind::secondary) {
      Eigen::Vector3d d;
      do {
        d = Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
      } while (hit.ground && d.z() < 0.02);
      next.direction = d.cast<float>();
    }
    out.push_back(next);
  }
  return out;
}

double thread_seconds() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Processor seconds of the slowest thread (the machine may be busy with other things).
double seconds(std::size_t count, int threads, const std::function<void(std::size_t, std::size_t)>& trace) {
  std::vector<double> spent(static_cast<std::size_t>(threads));
  std::vector<std::thread> pool;
  for (std::size_t t = 0; t < spent.size(); ++t) {
    pool.emplace_back([&, t] {
      const double start = thread_seconds();
      trace(count * t / spent.size(), count * (t + 1) / spent.size());
      spent[t] = thread_seconds() - start;
    });
  }
  for (std::thread& thread : pool) thread.join();
  return *std::max_element(spent.begin(), spent.end());
}

void run(const std::string& name, Scene scene, bool periodic, std::uint64_t flatten_below) {
  scene.domain.periodic = periodic;
  if (!periodic) scene.ground.reset();
  auto start = Clock::now();
  IntersectorOptions options;
  options.flatten_below = flatten_below;
  const Intersector intersector(scene, options);
  const double build = seconds_since(start);
  start = Clock::now();
  const Bare bare(scene);
  fmt::print("{} ({}, {}): build {:.2f} s, {:.0f} MiB (bare: {:.2f} s, {:.0f} MiB)\n", name,
             periodic ? "periodic, ground" : "open, no ground", flatten_below ? "flat" : "instanced", build,
             static_cast<double>(intersector.memory_bytes()) / 1048576, seconds_since(start),
             static_cast<double>(bare.device.memory_bytes()) / 1048576);
  constexpr std::size_t count = 200'000;
  for (const Kind kind : {Kind::primary, Kind::secondary, Kind::sun}) {
    const std::vector<Ray> rays = make_rays(scene, intersector, kind, count);
    for (const int threads : {1, 2}) {
      std::atomic<std::size_t> hits{0}, bare_hits{0};
      double ours = 1e30, theirs = 1e30;
      for (int repeat = 0; repeat < 5; ++repeat) {
        hits = bare_hits = 0;
        ours = std::min(ours, seconds(count, threads, [&](std::size_t from, std::size_t to) {
                          std::size_t n = 0;
                          Hit hit;
                          for (std::size_t i = from; i < to; ++i)
                            n += kind == Kind::sun ? intersector.occluded(rays[i])
                                                   : intersector.intersect(rays[i], hit) == Escape::hit;
                          hits += n;
                        }));
        theirs = std::min(theirs, seconds(count, threads, [&](std::size_t from, std::size_t to) {
                            embree::prepare_thread();
                            std::size_t n = 0;
                            embree::Found found;
                            for (std::size_t i = from; i < to; ++i) {
                              const embree::Segment segment{rays[i].origin, 1e-4f, rays[i].direction, 1e30f};
                              n += kind == Kind::sun ? bare.bvh.occluded(segment)
                                                     : bare.bvh.intersect(segment, found);
                            }
                            bare_hits += n;
                          }));
      }
      const char* names[] = {"primary  ", "secondary", "sun      "};
      fmt::print(
          "  {} {} thread(s): {:5.2f} Mray/s, bare {:5.2f} Mray/s, ratio {:.2f}  (hit {:.3f}, bare {:.3f})\n",
          names[static_cast<int>(kind)], threads, 1e-6 * count / ours, 1e-6 * count / theirs, theirs / ours,
          static_cast<double>(hits) / count, static_cast<double>(bare_hits) / count);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const char* environment = std::getenv("BPMS_DATA");
  const std::string data = argc > 1 ? argv[1] : environment ? environment : BPMS_SOURCE_DIR "/../shared/data";
  const Scene het = het01(data);
  const Scene hom = bench_hom(data);
  for (const bool periodic : {false, true}) {
    run("HET01", het, periodic, 1'000'000'000);
    run("HET01", het, periodic, 0);
    run("bench_hom", hom, periodic, 1'000'000'000);
  }
}
