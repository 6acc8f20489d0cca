#include "scene/intersect/embree.h"

#include <pmmintrin.h>
#include <xmmintrin.h>

#include <atomic>

#include "core/error.h"

namespace bpms::embree {

void prepare_thread() {
  thread_local bool done = false;
  if (done) return;
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  done = true;
}

struct Device::Memory {
  std::atomic<std::int64_t> bytes{0};
};

Device::Device() : memory_(std::make_unique<Memory>()), device_(rtcNewDevice(nullptr)) {
  if (device_ == nullptr)
    throw Error(ErrorKind::missing_resource, "Embree cannot be started on this processor");
  const auto count = [](void* memory, ssize_t bytes, bool) {
    static_cast<Memory*>(memory)->bytes += bytes;
    return true;
  };
  rtcSetDeviceMemoryMonitorFunction(device_, count, memory_.get());
}

Device::~Device() {
  if (device_ != nullptr) rtcReleaseDevice(device_);
}

std::uint64_t Device::memory_bytes() const {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(0, memory_->bytes.load()));
}

void Device::check(const char* doing) const {
  switch (rtcGetDeviceError(device_)) {
    case RTC_ERROR_NONE:
      return;
    case RTC_ERROR_OUT_OF_MEMORY:
      fail(ErrorKind::missing_resource, {}, "out of memory while {}", doing);
    default:
      fail(ErrorKind::internal, {}, "Embree refuses {}", doing);
  }
}

Bvh::Bvh(const Device& device) : device_(device), scene_(rtcNewScene(device.get())) {
  device_.check("making a scene");
  // Robust: no ray slips between two triangles that share an edge.
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
}

Bvh::~Bvh() {
  if (scene_ != nullptr) rtcReleaseScene(scene_);
}

void Bvh::attach(RTCGeometry geometry, std::uint32_t id) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene_, geometry, id);
  rtcReleaseGeometry(geometry);
  device_.check("adding geometry");
}

namespace {
template <class T>
std::span<T> buffer(const Device& device, RTCGeometry geometry, RTCBufferType type, RTCFormat format,
                    std::size_t count) {
  void* data = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), count);
  device.check("allocating geometry");
  if (data == nullptr) throw Error(ErrorKind::missing_resource, "out of memory for the scene's geometry");
  return {static_cast<T*>(data), count};
}
}  // namespace

template <class Primitives>
void Bvh::attach_user(Primitives& all, std::size_t count, std::uint32_t id) {
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(count));
  rtcSetGeometryUserData(geometry, &all);
  rtcSetGeometryBoundsFunction(geometry, &Primitives::bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, &Primitives::intersect);
  rtcSetGeometryOccludedFunction(geometry, &Primitives::occluded);
  attach(geometry, id);
}

const DiscClusters& Bvh::add_discs(std::uint32_t id, const std::vector<Disc>& discs) {
  DiscClusters& all = *discs_.emplace_back(std::make_unique<DiscClusters>(discs));
  attach_user(all, all.clusters(), id);
  return all;
}

const Shapes& Bvh::add_shapes(std::uint32_t id, std::vector<Shape> shapes) {
  Shapes& all = *shapes_.emplace_back(std::make_unique<Shapes>(std::move(shapes)));
  attach_user(all, all.size(), id);
  return all;
}

std::uint64_t Bvh::own_bytes() const {
  std::uint64_t out = 0;
  for (const auto& discs : discs_) out += discs->memory_bytes();
  for (const auto& shapes : shapes_) out += shapes->memory_bytes();
  return out;
}

void Bvh::add_triangles(std::uint32_t id, std::size_t vertices, std::size_t triangles,
                        const std::function<void(const Triangles&)>& fill) {
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  fill({buffer<std::array<float, 3>>(device_, geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, vertices),
        buffer<std::array<std::uint32_t, 3>>(device_, geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3,
                                             triangles)});
  attach(geometry, id);
}

void Bvh::add_instance(std::uint32_t id, const Bvh& prototype, const Placement& p) {
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, prototype.scene_);
  Eigen::Matrix<float, 3, 4> columns;
  columns << p.turned_and_scaled.cast<float>(), p.origin.cast<float>();
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
  attach(geometry, id);
}

void Bvh::commit() {
  rtcCommitScene(scene_);
  device_.check("building the scene's hierarchy");
}

}  // namespace bpms::embree
