// One shape stated in two ways reflects the same. Tilings: tests/simulate/same_scene_test.cpp.
#include <Eigen/Geometry>

#include "core/random.h"
#include "plant/geometry/bezier.h"
#include "tests/physics/physics.h"

namespace bpms::test {
namespace {

constexpr const char* four_views = "[[0, 0], [35, 100], [45, 200], [65, 280]]";

void expect_same_brf(const SensorResult& a, const SensorResult& b, double most_error) {
  for (const Component component : {Component::all, Component::co_sgl, Component::uc_sgl, Component::mlt})
    for (std::size_t view = 0; view < 4; ++view) {
      const Estimates &x = part_of(a, Origin::total, component), &y = part_of(b, Origin::total, component);
      expect_agree({x.value[view], x.standard_error[view]}, {y.value[view], y.standard_error[view]},
                   component == Component::all ? most_error : 4 * most_error,
                   fmt::format("{} of view {}", name_of(component), view));
    }
}

std::string triangle_obj(const std::vector<Eigen::Vector3d>& corners) {
  std::string out, faces;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    out += fmt::format("v {} {} {}\n", corners[i].x(), corners[i].y(), corners[i].z());
    if (i % 3 == 2) faces += fmt::format("f {} {} {}\n", i - 1, i, i + 1);
  }
  return out + faces;
}

SceneText mesh_canopy() {
  return {.leaf = bilambertian("0.5", "0.3") + "reflectance_back = 0.3",
          .soil = lambertian("0.3"),
          .mesh = "mesh.obj",
          .sun = sun_at(35, 100),
          .sensor = views(four_views),
          .sampling = "samples = 65536"};
}

// A tuft of triangles, six times: as instances that are turned and scaled, and written out by hand.
TEST(Geometry, InstancesAreOneMeshWrittenOut) {
  Philox random(4, 2);
  std::vector<Eigen::Vector3d> tuft;
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector3d at(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), random.uniform(0.2, 0.7));
    for (int corner = 0; corner < 3; ++corner)
      tuft.push_back(at + Eigen::Vector3d(random.uniform(-0.15, 0.15), random.uniform(-0.15, 0.15),
                                          random.uniform(-0.15, 0.15)));
  }
  std::string positions = "[";
  std::vector<Eigen::Vector3d> all;
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector3d at(random.uniform(-1, 1), random.uniform(-1, 1), 0);
    const double turn_deg = random.uniform(0, 360);
    positions += fmt::format("[{}, {}, 0, {}], ", at.x(), at.y(), turn_deg);
    const Eigen::AngleAxisd turn(radians(turn_deg), Eigen::Vector3d::UnitZ());
    for (const Eigen::Vector3d& corner : tuft) all.push_back(turn * (1.2 * corner) + at);
  }
  const TemporaryFolder folder;
  SceneText scene = mesh_canopy();
  scene.positions = positions + "]\nscale = 1.2";
  folder.write("mesh.obj", triangle_obj(tuft));
  const SensorResult instances = run_of(folder, scene, "", 1);
  scene.positions = "[[0, 0, 0]]";
  folder.write("mesh.obj", triangle_obj(all));
  const SensorResult written = run_of(folder, scene, "", 2);
  expect_same_brf(instances, written, 0.005);
}

// Leaves that are bent and twisted, as patches and as their own points on a fine grid (a quarter of a
// millimetre off the surface, on leaves of 40 cm).
TEST(Geometry, BezierPatchesAreFineTriangles) {
  Philox random(7, 3);
  BezierPatch leaf;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const double along = static_cast<double>(i) / 3, across = static_cast<double>(j) / 3 - 0.5;
      const double turn = along * radians(60), width = 0.12 * (1.2 - along);
      leaf[4 * i + j] = {0.4 * along, across * width * std::cos(turn),
                         0.3 + 0.5 * along - 0.6 * along * along + across * width * std::sin(turn) +
                             0.03 * std::abs(across)};
    }
  std::string patch;
  for (const Eigen::Vector3d& point : leaf)
    patch += fmt::format("{} {} {}\n", point.x(), point.y(), point.z());
  constexpr int steps = 32;
  std::vector<Eigen::Vector3d> corners;
  const auto at = [&](int i, int j) {
    return patch_point(leaf, static_cast<double>(i) / steps, static_cast<double>(j) / steps).position;
  };
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j)
      for (const auto& [a, b] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}})
        corners.push_back(at(i + a, j + b));
  const TemporaryFolder folder;
  folder.write("leaf.bpt", patch);
  folder.write("mesh.obj", triangle_obj(corners));
  SceneText scene = mesh_canopy();
  scene.positions = "[";
  for (int i = 0; i < 80; ++i)
    scene.positions += fmt::format("[{}, {}, {}, {}], ", random.uniform(-1, 1), random.uniform(-1, 1),
                                   random.uniform(0, 0.5), random.uniform(0, 360));
  scene.positions += "]";
  const SensorResult triangles = run_of(folder, scene, "", 1);
  std::string text = scene.str();
  text.replace(text.find("mesh = \"mesh.obj\""), 17, "patches = \"leaf.bpt\"");
  const SensorResult patches = simulate(read_simulation(folder.write("patches.toml", text)), 2).sensors.at(0);
  expect_same_brf(patches, triangles, 0.005);
}

// A sphere by its formula and by triangles with its normals at their corners: as bright in each part of an
// image, where triangles alone are off by their facets. 96 x 192 of them leave out (pi/96)^2 / 12 of what the
// silhouette cuts, some 1e-4.
TEST(Geometry, InterpolatedNormalsMakeASphere) {
  constexpr int rings = 96, sectors = 192;
  std::string vertices, normals, faces;
  for (int i = 0; i <= rings; ++i)
    for (int k = 0; k < sectors; ++k) {
      const double t = pi * i / rings, p = 2 * pi * k / sectors;
      const std::string xyz = fmt::format("{:.9f} {:.9f} {:.9f}", std::sin(t) * std::cos(p),
                                          std::sin(t) * std::sin(p), std::cos(t));
      vertices += "v " + xyz + "\n", normals += "vn " + xyz + "\n";
    }
  const auto corner = [](int i, int k) { return i * sectors + k % sectors + 1; };
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < sectors; ++k) {
      if (i > 0)
        faces +=
            fmt::format("f {0}//{0} {1}//{1} {2}//{2}\n", corner(i, k), corner(i + 1, k), corner(i, k + 1));
      if (i < rings - 1)
        faces += fmt::format("f {0}//{0} {1}//{1} {2}//{2}\n", corner(i + 1, k), corner(i + 1, k + 1),
                             corner(i, k + 1));
    }
  const TemporaryFolder folder;
  folder.write("mesh.obj", vertices + normals + faces);
  folder.write("sphere.txt", "sphere 0 0 0 1\n");
  SceneText scene = mesh_canopy();
  scene.domain = "boundary = \"open\"";
  scene.soil.clear(), scene.ground.clear();
  scene.leaf = lambertian("0.5");
  scene.positions = "[[0, 0, 2]]";
  scene.sky = white_sky;
  scene.sensor =
      "name = \"side\"\ntype = \"orthographic\"\nlocation = [0, -3, 2]\ndirection = [0, 1, 0]\n"
      "width_m = 2\nwidth_px = 6\nheight_px = 6\n";
  scene.sampling = "samples = 65536\nnormals = \"interpolated\"";
  const SensorResult mesh = run_of(folder, scene, "", 1);
  std::string text = scene.str();
  text.replace(text.find("mesh = \"mesh.obj\""), 17, "shapes = \"sphere.txt\"");
  const SensorResult sphere = simulate(read_simulation(folder.write("sphere.toml", text)), 2).sensors.at(0);
  for (std::size_t pixel = 0; pixel < 36; ++pixel)
    expect_agree(estimate_of(mesh, pixel), estimate_of(sphere, pixel), 0.01, fmt::format("pixel {}", pixel));
}

// A leaf of 1 m2 that floats over soil, seen from above with its shadow beside it; the reference area is
// 4 m2, whether it is repeated or not.
TEST(Geometry, OpenAndPeriodicDomainsHaveOneReferenceArea) {
  const TemporaryFolder folder;
  folder.write("mesh.obj", sheet_obj(0.3, 0.5));
  SceneText scene = mesh_canopy();
  scene.leaf = lambertian("0.4");
  scene.soil = lambertian("0.2");
  scene.sun = sun_at(45, 90);
  scene.sensor = views("[[0, 0]]");
  scene.sampling = "samples = 262144";
  for (const char* boundary : {"open", "periodic"}) {
    scene.domain = fmt::format("size_m = [2, 2]\nboundary = \"{}\"", boundary);
    const SensorResult result = run_of(folder, scene);
    const Estimates &canopy = part_of(result, Origin::total, Component::co_sgl),
                    &soil = part_of(result, Origin::total, Component::uc_sgl);
    expect_agree({canopy.value[0], canopy.standard_error[0]}, {0.4 / 4, 0}, 0.002, boundary);
    // The shadow lies 0.3 m to the west; so much of it is seen.
    expect_agree({soil.value[0], soil.standard_error[0]}, {0.2 * (3 - 0.3) / 4, 0}, 0.002, boundary);
  }
}

}  // namespace
}  // namespace bpms::test
