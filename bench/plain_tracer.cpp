#include "bench/plain_tracer.h"

#include <embree3/rtcore.h>
#include <pmmintrin.h>
#include <xmmintrin.h>

#include <cmath>
#include <ctime>
#include <random>

#include "core/units.h"

namespace bpms::bench {
namespace {

using Eigen::Vector3f;

struct Met {
  bool any = false;
  Vector3f at, normal;
  bool leaf = false;
};

class PlainScene {
 public:
  explicit PlainScene(const Scene& scene) : half_(static_cast<float>(scene.domain.size_m.x() / 2)) {
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    device_ = rtcNewDevice(nullptr);
    scene_ = rtcNewScene(device_);
    std::vector<Disc> discs;
    for (const Instance& instance : scene.instances) {
      const Eigen::Matrix3f turn = instance.rotation.matrix().cast<float>();
      const auto scale = static_cast<float>(instance.scale);
      for (const Disc& own : scene.prototypes[instance.prototype].discs) {
        const Disc disc{instance.position_m.cast<float>() + scale * (turn * own.centre_m),
                        scale * own.radius_m, turn * own.normal};
        for (const float x : {-2 * half_, 0.0f, 2 * half_}) {
          for (const float y : {-2 * half_, 0.0f, 2 * half_}) {
            Disc copy = disc;
            copy.centre_m += Vector3f(x, y, 0);
            const float reach = half_ + 1.01f * disc.radius_m;
            if (std::abs(copy.centre_m.x()) < reach && std::abs(copy.centre_m.y()) < reach)
              discs.push_back(copy);
            top_ = std::max(top_, copy.centre_m.z() + disc.radius_m);
          }
        }
      }
    }
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT);
    auto* vertex = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, discs.size()));
    auto* normal = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_NORMAL, 0, RTC_FORMAT_FLOAT3, 12, discs.size()));
    for (std::size_t i = 0; i < discs.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        vertex[4 * i + static_cast<std::size_t>(k)] = discs[i].centre_m[k];
        normal[3 * i + static_cast<std::size_t>(k)] = discs[i].normal[k];
      }
      vertex[4 * i + 3] = discs[i].radius_m;
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~PlainScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  PlainScene(const PlainScene&) = delete;
  PlainScene& operator=(const PlainScene&) = delete;
  float top() const { return top_; }
  float half() const { return half_; }

  Met trace(Vector3f origin, const Vector3f& direction) const {
    for (int wrap = 0; wrap < 1000; ++wrap) {
      float to_side = 1e30f;
      int side = 0;
      for (int axis = 0; axis < 2; ++axis) {
        if (direction[axis] == 0) continue;
        const float t = (std::copysign(half_, direction[axis]) - origin[axis]) / direction[axis];
        if (t < to_side) to_side = t, side = axis;
      }
      const float dz = direction.z();
      const float to_ground = dz < 0 ? -origin.z() / dz : 1e30f;
      const float to_top = dz > 0 ? (top_ - origin.z()) / dz : 1e30f;
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      RTCRayHit ray{};
      ray.ray.org_x = origin.x(), ray.ray.org_y = origin.y(), ray.ray.org_z = origin.z();
      ray.ray.dir_x = direction.x(), ray.ray.dir_y = direction.y(), ray.ray.dir_z = dz;
      ray.ray.tnear = 1e-4f;
      ray.ray.tfar = std::min({to_side, to_ground, to_top});
      ray.ray.mask = 0xffffffffu;
      ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene_, &context, &ray);
      if (ray.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
        const Vector3f n(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z);
        return {true, origin + ray.ray.tfar * direction, n.normalized(), true};
      }
      if (to_ground <= to_side) return {true, origin + to_ground * direction, Vector3f::UnitZ(), false};
      if (to_top <= to_side) return {};
      origin += to_side * direction;
      origin[side] = -std::copysign(half_, direction[side]);
    }
    return {};
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
  float half_;
  float top_ = 0;
};

}  // namespace

PlainResult trace_plainly(const Simulation& simulation, double vza_deg, std::uint64_t paths,
                          std::uint64_t seed) {
  return PlainTracer(simulation).trace(vza_deg, paths, seed);
}

struct PlainTracer::Impl {
  explicit Impl(const Simulation& all) : simulation(all), scene(all.scene) {}
  const Simulation& simulation;
  PlainScene scene;
};
PlainTracer::PlainTracer(const Simulation& simulation) : impl_(std::make_unique<Impl>(simulation)) {}
PlainTracer::~PlainTracer() = default;

PlainResult PlainTracer::trace(double vza_deg, std::uint64_t paths, std::uint64_t seed) const {
  const Simulation& simulation = impl_->simulation;
  const PlainScene& scene = impl_->scene;
  const std::size_t bands = std::min<std::size_t>(2, simulation.bands.count()), last = bands - 1;
  const auto& leaf = simulation.materials[0];
  const auto& soil = simulation.materials[1];
  const Domain& domain = simulation.scene.domain;
  const Vector3f to_sun = simulation.light.suns.front().direction.cast<float>();
  const Vector3f down = -direction_from_angles(radians(vza_deg), radians(180), domain).cast<float>();
  std::mt19937 generator(static_cast<std::uint32_t>(seed));
  std::uniform_real_distribution<float> uniform(0, 1);
  double sum[2] = {0, 0}, squares[2] = {0, 0};
  const std::clock_t start = std::clock();
  for (std::uint64_t path = 0; path < paths; ++path) {
    Vector3f origin((2 * uniform(generator) - 1) * scene.half(), (2 * uniform(generator) - 1) * scene.half(),
                    scene.top());
    Vector3f direction = down;
    double weight[2] = {1, bands > 1 ? 1.0 : 0.0}, value[2] = {0, 0};
    for (;;) {
      const Met met = scene.trace(origin, direction);
      if (!met.any) break;
      const Vector3f facing = met.normal.dot(direction) < 0 ? met.normal : Vector3f(-met.normal);
      const float cosine = facing.dot(to_sun);
      if ((met.leaf || cosine > 0) && !scene.trace(met.at, to_sun).any) {
        for (std::size_t b = 0; b < bands; ++b) {
          const double factor = !met.leaf    ? soil.reflectance[0][b]
                                : cosine > 0 ? leaf.reflectance[0][b]
                                             : leaf.transmittance[b];
          value[b] += weight[b] * factor * std::abs(static_cast<double>(cosine)) *
                      simulation.light.suns.front().irradiance[b] / pi;
        }
      }
      bool reflect = true;
      for (std::size_t b = 0; b < bands; ++b)
        weight[b] *= met.leaf ? leaf.reflectance[0][b] + leaf.transmittance[b] : soil.reflectance[0][b];
      if (met.leaf) {  // as the NIR shares it; the red weight makes up for it
        const double share =
            leaf.reflectance[0][last] / (leaf.reflectance[0][last] + leaf.transmittance[last]);
        reflect = static_cast<double>(uniform(generator)) < share;
        const double red = reflect ? leaf.reflectance[0][0] / share : leaf.transmittance[0] / (1 - share);
        weight[0] *= red / (leaf.reflectance[0][0] + leaf.transmittance[0]);
      }
      const double largest = std::max(weight[0], weight[1]);
      if (largest < 0.1) {
        constexpr double survival = 0.5;
        if (static_cast<double>(uniform(generator)) > survival) break;
        weight[0] /= survival, weight[1] /= survival;
      }
      const Vector3f normal = reflect ? facing : Vector3f(-facing);
      const float z = 2 * uniform(generator) - 1, angle = 2 * static_cast<float>(pi) * uniform(generator);
      const float radius = std::sqrt(1 - z * z);
      direction = (normal + Vector3f(radius * std::cos(angle), radius * std::sin(angle), z)).normalized();
      origin = met.at;
    }
    for (std::size_t b = 0; b < bands; ++b) sum[b] += value[b], squares[b] += value[b] * value[b];
  }
  PlainResult out{};
  out.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const auto n = static_cast<double>(paths);
  for (std::size_t b = 0; b < bands; ++b) {
    out.mean[b] = sum[b] / n;
    out.variance[b] = (squares[b] / n - out.mean[b] * out.mean[b]);
  }
  return out;
}

}  // namespace bpms::bench
