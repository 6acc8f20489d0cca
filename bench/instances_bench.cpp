// Large scenes of instances: seconds to build, bytes as counted, as estimated and as the system sees them
// (resident, and its peak over the process), and rays per second. 10^10 triangles from 10^6 unique ones, and
// a million instances of tilted shoots, both as they are and nested in trees.
//   bench_instances
#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <string>

#include "bench/process_status.h"
#include "core/random.h"
#include "core/units.h"
#include "scene/geometry/assemble.h"
#include "scene/intersect/intersector.h"

namespace {

using namespace bpms;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Leaves of 8 triangles scattered in a crown of 2 m.
std::shared_ptr<const Mesh> crown(std::size_t triangles, std::uint64_t seed) {
  auto mesh = std::make_shared<Mesh>();
  Philox random(seed, 1);
  mesh->organs.push_back({0, "leaves", "leaf", "leaf", 0, 0});
  while (mesh->triangles.size() < triangles) {
    const Eigen::Vector3d at(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(1, 3));
    const Eigen::Vector3d a = Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    const Eigen::Vector3d b = a.unitOrthogonal();
    const auto first = static_cast<std::uint32_t>(mesh->positions_m.size());
    for (int k = 0; k < 5; ++k)
      for (const double side : {-0.01, 0.01})
        mesh->positions_m.push_back((at + 0.02 * k * a + side * b).cast<float>());
    for (std::uint32_t k = 0; k < 4; ++k) {
      mesh->triangles.push_back({first + 2 * k, first + 2 * k + 1, first + 2 * k + 3});
      mesh->triangles.push_back({first + 2 * k, first + 2 * k + 3, first + 2 * k + 2});
    }
  }
  mesh->organ_of_triangle.assign(mesh->triangles.size(), 0);
  return mesh;
}

Scene empty(double size_m) {
  Scene scene;
  scene.domain.size_m = {size_m, size_m};
  scene.materials = {"leaf", "soil"};
  scene.ground = Ground{0, 1};
  return scene;
}

void build(const std::string& name, const Scene& scene) {
  std::uint64_t unique = 0, effective = 0;
  std::vector<std::uint64_t> primitives;
  for (const Prototype& p : scene.prototypes) {
    primitives.push_back(p.discs.size() + p.shapes.size() + (p.mesh ? p.mesh->triangles.size() : 0));
    unique += primitives.back();
  }
  for (const Instance& i : scene.instances) effective += primitives[i.prototype];
  const double before = status_mib("VmRSS");
  auto start = Clock::now();
  const Intersector intersector(scene);
  const double seconds = seconds_since(start);
  const double resident = status_mib("VmRSS") - before;
  fmt::print(
      "{}: {} instances, {:.3g} primitives from {:.3g}\n  built in {:.2f} s; counted {:.0f} MiB, estimated "
      "{:.0f} MiB, "
      "resident +{:.0f} MiB ({:.0f} bytes an instance), process {:.0f} MiB, peak {:.0f} MiB\n",
      name, scene.instances.size(), static_cast<double>(effective), static_cast<double>(unique), seconds,
      static_cast<double>(intersector.memory_bytes()) / 1048576,
      static_cast<double>(intersector.estimated_bytes()) / 1048576, resident,
      resident * 1048576 / static_cast<double>(scene.instances.size()), status_mib("VmRSS"),
      status_mib("VmHWM"));
  Philox random(3, 3);
  constexpr int rays = 200'000;
  int hits = 0;
  start = Clock::now();
  for (int k = 0; k < rays; ++k) {
    const double half = 0.5 * scene.domain.size_m.x();
    const Eigen::Vector3f o(static_cast<float>(random.uniform(-half, half)),
                            static_cast<float>(random.uniform(-half, half)), intersector.top_m());
    Hit hit;
    hits += intersector.intersect({o, Eigen::Vector3f(0.3f, 0.2f, -1).normalized(), 1e30f, {}}, hit) ==
                Escape::hit &&
            !hit.ground;
  }
  fmt::print("  {:.2f} Mray/s from above, one thread; {:.3f} met a plant\n",
             1e-6 * rays / seconds_since(start), static_cast<double>(hits) / rays);
}

Scene ten_billion() {
  Scene scene = empty(400);
  constexpr int kinds = 10;
  for (int k = 0; k < kinds; ++k) {
    Prototype& tree = scene.prototypes.emplace_back();
    tree.name = fmt::format("tree{}", k);
    tree.mesh = crown(100'000, static_cast<std::uint64_t>(k));
    tree.material_of_organ = {0};
  }
  Philox random(1, 1);
  constexpr int trees = 100'000;  // 10^5 of 10^5 triangles
  for (int k = 0; k < trees; ++k) {
    const Eigen::Vector3d at(random.uniform(-200, 200), random.uniform(-200, 200), 0);
    scene.instances.push_back({static_cast<std::uint32_t>(k % kinds), at, random.uniform(0, 2 * pi),
                               random.uniform(0.7, 1.3), static_cast<std::uint32_t>(k)});
  }
  return scene;
}

Scene shoots(AssemblyLayout layout) {
  Scene scene = empty(200);
  Prototype& shoot = scene.prototypes.emplace_back();
  shoot.name = "shoot";
  Philox random(2, 2);
  for (int k = 0; k < 1000; ++k) {
    const Eigen::Vector3d at(random.normal() * 0.05, random.normal() * 0.05, random.uniform(0, 0.3));
    const Eigen::Vector3d n = Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    shoot.discs.push_back({at.cast<float>(), 0.004f, n.cast<float>()});
  }
  Assembly tree{"tree", {}};
  for (int k = 0; k < 200; ++k) {
    const Eigen::Vector3d at(random.normal() * 0.5, random.normal() * 0.5, random.uniform(0.5, 3));
    tree.parts.push_back({0, at, Rotation::about_axes(random.uniform(0, 6), random.uniform(0, 1), 0), 1});
  }
  for (std::uint32_t k = 0; k < 5000; ++k) {
    const Eigen::Vector3d at(random.uniform(-100, 100), random.uniform(-100, 100), 0);
    scene.instances.push_back({1, at, random.uniform(0, 6), random.uniform(0.8, 1.2), k});
  }
  resolve_assemblies({tree}, layout, scene);
  return scene;
}

}  // namespace

int main() {
  build("10^10 triangles", ten_billion());
  build("a million shoots", shoots(AssemblyLayout::apart));
  build("the same, laid out by memory", shoots(AssemblyLayout::by_memory));
}
