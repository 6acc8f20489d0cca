// Gap fractions of a wheat-like stand at ten zenith angles to a standard error of 0.002: seconds to make it
// ready and to trace it, and rays per second over those of bare Embree (any hit) on the same rays and all
// triangles in one hierarchy; once with every plant its own mesh, once with a hundred meshes a hundred times.
//   bench_gaps [PLANTS [TOLERANCE_M]]
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>

#include "core/parallel.h"
#include "core/random.h"
#include "core/units.h"
#include "plant/plant_mesh.h"
#include "scene/intersect/embree.h"
#include "scene/structure/structure.h"

namespace {

using namespace bpms;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// A tiller with four leaves and an ear, no two alike.
Mesh wheat(Philox& random, double tolerance_m) {
  std::string text = "units cm\n[s[+l][+l]s[+l][+l]h]\n";
  for (int k = 1; k <= 4; ++k)
    text += fmt::format(
        "+ {} {{ a_twist {} }}\nl {} {{ material leaf a_length {} a_width {} f_inclination p {} {} f_width n "
        "0 0.6 "
        "0.3 1 1 0 f_curvature n 0 20 1 5 }}\n",
        k, 180 * k + random.uniform(-40, 40), k, random.uniform(16, 26), random.uniform(1.0, 1.6),
        random.uniform(8, 25), random.uniform(30, 90));
  text += "s { material stem a_length 30 a_radius 0.18 }\nh { material ear a_length 8 a_radius 0.5 }\n";
  return plant_mesh(parse_plant("wheat.bpms", text), {tolerance_m});
}

// 400 plants a square metre, in rows 0.15 m apart.
Scene stand(std::size_t plants, std::size_t different, double tolerance_m) {
  Scene scene;
  const double side = std::sqrt(static_cast<double>(plants) / 400), rows = std::round(side / 0.15);
  scene.domain.size_m = {side, side};
  scene.materials = {"leaf", "stem", "ear"};
  scene.prototypes.resize(different);
  parallel_for(different, [&](std::size_t k) {
    Philox random(5, k);
    auto mesh = std::make_shared<Mesh>(wheat(random, tolerance_m));
    for (const Mesh::Organ& organ : mesh->organs)
      scene.prototypes[k].material_of_organ.push_back(organ.kind == "leaf"   ? 0
                                                      : organ.kind == "stem" ? 1
                                                                             : 2);
    scene.prototypes[k].mesh = std::move(mesh);
  });
  Philox random(6);
  for (std::size_t k = 0; k < plants; ++k) {
    const double row = std::floor(random.uniform() * rows);
    const Eigen::Vector3d at(((row + 0.5) / rows - 0.5) * side + 0.01 * random.normal(),
                             (random.uniform() - 0.5) * side, 0);
    scene.instances.push_back({static_cast<std::uint32_t>(k % different), at, 2 * pi * random.uniform(), 1});
  }
  return scene;
}

struct Bare {
  explicit Bare(const Scene& scene) : bvh(device) {
    std::size_t vertices = 0, triangles = 0;
    for (const Instance& i : scene.instances) {
      vertices += scene.prototypes[i.prototype].mesh->positions_m.size();
      triangles += scene.prototypes[i.prototype].mesh->triangles.size();
    }
    bvh.add_triangles(0, vertices, triangles, [&](const embree::Bvh::Triangles& to) {
      std::uint32_t first = 0, at = 0;
      for (const Instance& i : scene.instances) {
        const Mesh& mesh = *scene.prototypes[i.prototype].mesh;
        for (std::size_t v = 0; v < mesh.positions_m.size(); ++v) {
          const Eigen::Vector3f p =
              (i.position_m + i.rotation * mesh.positions_m[v].cast<double>()).cast<float>();
          to.vertex[first + v] = {p.x(), p.y(), p.z()};
        }
        for (const auto& [a, b, c] : mesh.triangles) to.index[at++] = {first + a, first + b, first + c};
        first += static_cast<std::uint32_t>(mesh.positions_m.size());
      }
    });
    bvh.commit();
  }
  embree::Device device;
  embree::Bvh bvh;
};

// The rays that gap_fraction starts, in its order of angles, at random places.
double bare_rays_per_second(const Bare& bare, const Scene& scene, const std::vector<double>& zenith_deg) {
  constexpr std::size_t each = 100'000;
  const auto start = Clock::now();
  parallel_for(zenith_deg.size(), [&](std::size_t a) {
    embree::prepare_thread();
    Philox random(8, a);
    const double zenith = radians(zenith_deg[a]);
    for (std::size_t k = 0; k < each; ++k) {
      const double azimuth = 2 * pi * random.uniform();
      const Eigen::Vector3d from((random.uniform() - 0.5) * scene.domain.size_m.x(),
                                 (random.uniform() - 0.5) * scene.domain.size_m.y(), 0);
      const Eigen::Vector3d way(std::sin(zenith) * std::cos(azimuth), std::sin(zenith) * std::sin(azimuth),
                                std::cos(zenith));
      bare.bvh.occluded({from.cast<float>(), 1e-4f, way.cast<float>(), 1e30f});
    }
  });
  return static_cast<double>(each * zenith_deg.size()) / seconds_since(start);
}

void run(const char* name, const Scene& scene) {
  const std::vector<double> zenith_deg{0, 10, 20, 30, 40, 50, 57.5, 65, 70, 75};
  auto start = Clock::now();
  const GapScene rays(scene);
  const double build = seconds_since(start);
  start = Clock::now();
  const std::vector<Gap> gaps = gap_fraction(rays, gap_directions(zenith_deg), {1u << 26, 1, 0.002});
  const double trace = seconds_since(start);
  double worst = 0, count = 0;
  for (const Gap& gap : gaps) {
    worst = std::max(worst, gap.plant.standard_error);
    count += static_cast<double>(gap.rays);
  }
  start = Clock::now();
  const SurfaceSums sums = surface_sums(scene, {}, {.height_m = 0.8});
  const double facets = seconds_since(start);
  const Bare bare(scene);
  const double rate = bare_rays_per_second(bare, scene, zenith_deg);
  std::uint64_t triangles = 0;
  for (const Instance& i : scene.instances) triangles += scene.prototypes[i.prototype].mesh->triangles.size();
  fmt::print("{}: {} plants, {} triangles, LAI {:.2f}\n", name, scene.instances.size(), triangles,
             sums.leaf_area_m2 / scene.domain.size_m.prod());
  fmt::print(
      "  ready in {:.2f} s, ten angles to {:.4f} in {:.2f} s: {:.0f} rays, {:.2f} Mray/s, over bare Embree's "
      "{:.2f}: {:.2f}; facets in {:.2f} s\n",
      build, worst, trace, count, 1e-6 * count / trace, 1e-6 * rate, count / trace / rate, facets);
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t plants = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 10'000;
  const double tolerance_m = argc > 2 ? std::atof(argv[2]) : 1e-4;
  run("each its own mesh", stand(plants, plants, tolerance_m));
  run("a hundred meshes", stand(plants, std::min<std::size_t>(plants, 100), tolerance_m));
}
