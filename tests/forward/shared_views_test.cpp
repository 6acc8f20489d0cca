// BRF of views from shared photon paths: the reverse mode's values, honest errors and covariances, the same
// bits on any number of threads.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/parallel.h"
#include "simulate/forward/shared_views.h"
#include "tests/forward/lights.h"
#include "tests/simulate/scene_text.h"

namespace bpms::test {
namespace {

SharedViews shared_of(const Simulation& simulation, std::uint64_t seed = 1) {
  const Intersector intersector(simulation.scene);
  return trace_shared_views(simulation, intersector, *simulation.sensors[0], seed, 0);
}

SceneText lit_canopy(const TemporaryFolder& folder) {
  SceneText scene = canopy_text(folder, {.lai = 2, .size_m = {3, 3}, .bottom_m = 0.05});
  scene.leaf =
      bilambertian("[[600, 0.1], [800, 0.5]]", "[[600, 0.05], [800, 0.42]]") + "reflectance_back = 0.15\n";
  scene.soil = lambertian("0.3");
  scene.sun = sun_at(40, 100);
  scene.sky = white_sky;
  scene.wavelengths_nm = "[600, 800]";
  scene.sensor = views("[[0, 0], [40, 100], [45, 280], [75, 10], [85, 200]]");
  return scene;
}

// A square leaf in the place of each disc of a list: scenes of triangles have no grids for parallel rays.
std::string squares(const std::vector<Disc>& discs) {
  std::string vertices, faces;
  int count = 0;
  for (const Disc& disc : discs) {
    const Eigen::Vector3f side = disc.radius_m * disc.normal.unitOrthogonal();
    const Eigen::Vector3f other = disc.normal.cross(side);
    for (const auto& corner : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
      const Eigen::Vector3f at =
          disc.centre_m + static_cast<float>(corner.first) * side + static_cast<float>(corner.second) * other;
      vertices += fmt::format("v {} {} {}\n", at.x(), at.y(), at.z());
    }
    faces += fmt::format("f {0} {1} {2}\nf {0} {2} {3}\n", count + 1, count + 2, count + 3, count + 4);
    count += 4;
  }
  return vertices + faces;
}

void expect_the_reverse_mode(const Simulation& simulation) {
  const SharedViews forward = shared_of(simulation, 1);
  const SensorResult reverse = simulate(simulation, 2).sensors.at(0);
  const auto compare = [&](Origin origin, Component component, int order, double most_error) {
    const Estimates &a = part_of(forward.result, origin, component, order),
                    &b = part_of(reverse, origin, component, order);
    for (std::size_t i = 0; i < a.value.size(); ++i) {
      EXPECT_LT(std::abs(z_of(a, i, b, i)), 4.5)  // of some 100 comparisons
          << name_of(origin) << " " << name_of(component) << " " << order << " at " << i << ": " << a.value[i]
          << " and " << b.value[i];
      EXPECT_LT(std::hypot(a.standard_error[i], b.standard_error[i]), most_error * b.value[i]);
    }
  };
  for (const Origin origin : {Origin::total, Origin::direct, Origin::diffuse})
    compare(origin, Component::all, every_order, 0.03);
  for (const Component component : {Component::uc_sgl, Component::co_sgl, Component::mlt})
    if (component != Component::uc_sgl) compare(Origin::direct, component, every_order, 0.06);
  for (const int order : {1, 2, 3}) compare(Origin::total, Component::all, order, 0.1);
  for (std::size_t view = 0; view < forward.result.samples.size(); ++view)
    EXPECT_LE(std::abs(forward.result.gap.value[view] - reverse.gap.value[view]),
              4.5 * std::hypot(forward.result.gap.standard_error[view], reverse.gap.standard_error[view]));
}

TEST(SharedViews, AreTheReverseModesOverDiscs) {
  const TemporaryFolder folder;
  SceneText scene = lit_canopy(folder);
  scene.sampling = "samples = 131072";
  expect_the_reverse_mode(simulation_of(folder, scene));
}

TEST(SharedViews, AreTheReverseModesOverTriangles) {
  const TemporaryFolder folder;
  SceneText scene = lit_canopy(folder);
  folder.write("canopy.obj",
               squares(random_discs({.lai = 2, .radius_m = 0.1, .size_m = {3, 3}, .bottom_m = 0.1})));
  scene.discs.clear();
  scene.mesh = "canopy.obj";
  scene.sensor = views("[[0, 0], [40, 100], [60, 10]]");
  scene.sampling = "samples = 65536";
  expect_the_reverse_mode(simulation_of(folder, scene));
}

// Crowns that stand alike several times, some over the border: their grids are shared.
TEST(SharedViews, AreTheReverseModesOverInstances) {
  const TemporaryFolder folder;
  SceneText scene = canopy_text(folder, {.lai = 3, .radius_m = 0.02, .size_m = {0.8, 0.8}, .bottom_m = 0.1});
  scene.domain = "size_m = [3, 3]";
  scene.positions = "[[0, 0, 0], [1.3, 0.5, 0.1], [-0.6, 1.1, 0.3]]";
  scene.sun = sun_at(50, 30);
  scene.sky = white_sky;
  scene.sensor = views("[[0, 0], [50, 30], [70, 200]]");
  scene.sampling = "samples = 65536";
  expect_the_reverse_mode(simulation_of(folder, scene));
}

// Two suns, each with parts of its own.
TEST(SharedViews, AreTheReverseModesUnderTwoSuns) {
  const TemporaryFolder folder;
  SceneText scene = lit_canopy(folder);
  scene.sun = "[" + sun_at(40, 100) + ", " + sun_at(65, 300, "2.0") + "]";
  scene.sensor = views("[[0, 0], [60, 10]]");
  scene.sampling = "samples = 65536";
  const Simulation simulation = simulation_of(folder, scene);
  expect_the_reverse_mode(simulation);
  const SharedViews forward = shared_of(simulation, 3);
  const SensorResult reverse = simulate(simulation, 4).sensors.at(0);
  std::size_t of_one_sun = 0;
  for (std::size_t p = 0; p < forward.result.parts.size(); ++p) {
    const Part& part = forward.result.parts[p];
    if (part.sun == every_sun || part.order != every_order || part.component != Component::all) continue;
    ++of_one_sun;
    for (std::size_t q = 0; q < reverse.parts.size(); ++q) {
      const Part& other = reverse.parts[q];
      if (other.sun != part.sun || other.order != every_order || other.component != Component::all) continue;
      for (std::size_t i = 0; i < 4; ++i)
        EXPECT_LT(std::abs(z_of(forward.result.radiance[p], i, reverse.radiance[q], i)), 4.5) << part.sun;
    }
  }
  EXPECT_EQ(of_one_sun, 2u);
  for (std::size_t i = 0; i < 4; ++i)  // views x suns
    EXPECT_LT(std::abs(z_of(forward.result.sunlit_ground, i, reverse.sunlit_ground, i)), 4.5);
}

// A disc of 12 degrees, as no sun has it, and a sky that is bright on one side.
TEST(SharedViews, AreTheReverseModesUnderADiscAndASkyMap) {
  const TemporaryFolder folder;
  SceneText scene = lit_canopy(folder);
  scene.sensor = views("[[0, 0], [40, 100], [60, 10]]");
  scene.sampling = "samples = 65536";
  Simulation simulation = simulation_of(folder, scene);
  simulation.light.suns[0].radius = 0.21;
  expect_the_reverse_mode(
      with_sky_map(std::move(simulation), [](std::size_t, std::size_t column, std::size_t band) {
        return column < 12 ? 2.0f + static_cast<float>(band) : 0.5f;
      }));
}

TEST(SharedViews, BareGroundIsAsItIs) {
  const TemporaryFolder folder;
  SceneText scene;
  scene.soil = lambertian("0.3");
  scene.ground = "soil";
  scene.sun = sun_at(60, 0);
  scene.sky = white_sky;
  scene.sensor = views("[[0, 0], [30, 20], [80, 90]]");
  scene.sampling = "samples = 65536\nroulette = false";
  const SharedViews shared = shared_of(simulation_of(folder, scene));
  for (std::size_t view = 0; view < 3; ++view) {
    EXPECT_NEAR(part_of(shared.result, Origin::direct).value[view], 0.3, 1e-6);
    const Estimates& sky = part_of(shared.result, Origin::diffuse);  // not every vertex is looked at
    EXPECT_NEAR(sky.value[view], 0.3, 4 * sky.standard_error[view] + 1e-6);
    EXPECT_LT(sky.standard_error[view], 0.003);
  }
}

TEST(SharedViews, TargetIsReachedInEveryViewWithTheSameBitsOnAnyNumberOfThreads) {
  const TemporaryFolder folder;
  SceneText scene = lit_canopy(folder);
  scene.sampling = "target_se = \"1%\"";
  const Simulation simulation = simulation_of(folder, scene);
  std::vector<SharedViews> results;
  for (const int count : {1, 2, 7}) {
    set_threads(count);
    results.push_back(shared_of(simulation));
  }
  set_threads(0);
  EXPECT_EQ(results[0].stopped_by, "target_se");
  const Estimates& total = results[0].result.radiance[0];
  for (std::size_t i = 0; i < total.value.size(); ++i)
    EXPECT_LE(total.standard_error[i], 0.01 * total.value[i]);
  for (const SharedViews& other : results) {
    EXPECT_EQ(other.covariance, results[0].covariance);
    EXPECT_EQ(other.result.samples, results[0].result.samples);
    for (std::size_t part = 0; part < other.result.parts.size(); ++part)
      EXPECT_EQ(other.result.radiance[part].value, results[0].result.radiance[part].value);
  }
}

// Views share paths: the error of their sum needs the covariances. Coverage by Student's t of 31 degrees of
// freedom, over repeats with other seeds; their mean stands for the truth.
TEST(SharedViews, CovariancesAreHonest) {
  const TemporaryFolder folder;
  SceneText scene = canopy_text(folder, {.lai = 2, .size_m = {1, 1}, .bottom_m = 0.05});
  scene.sun = sun_at(30, 0);
  scene.sensor = views("[[10, 0], [15, 0], [20, 0]]");
  scene.sampling = "samples = 1024";
  const Simulation simulation = simulation_of(folder, scene);
  const Intersector intersector(simulation.scene);
  constexpr std::uint64_t repeats = 400;
  std::vector<double> sums, errors;
  double mean = 0, alone = 0, together = 0;
  for (std::uint64_t seed = 1; seed <= repeats; ++seed) {
    const SharedViews shared = trace_shared_views(simulation, intersector, *simulation.sensors[0], seed, 0);
    const Estimates& total = shared.result.radiance[0];
    double sum = 0, variance = 0;
    for (std::size_t v = 0; v < 3; ++v) {
      sum += total.value[v];
      alone += total.standard_error[v] * total.standard_error[v];
      EXPECT_NEAR(std::sqrt(shared.covariance[v * 3 + v]), total.standard_error[v], 1e-9);
      for (std::size_t w = 0; w < 3; ++w) variance += shared.covariance[v * 3 + w];
    }
    together += variance;
    sums.push_back(sum), errors.push_back(std::sqrt(variance));
    mean += sum / static_cast<double>(repeats);
  }
  EXPECT_GT(together, 1.2 * alone);  // there is something to account for
  const auto covered = [&](double t) {
    int count = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) count += std::abs(sums[i] - mean) < t * errors[i];
    return count / static_cast<double>(repeats);
  };
  // Quantiles of t with 31 degrees of freedom; four binomial standard errors of 400.
  EXPECT_NEAR(covered(1.010), 0.68, 4 * std::sqrt(0.68 * 0.32 / repeats));
  EXPECT_NEAR(covered(2.040), 0.95, 4 * std::sqrt(0.95 * 0.05 / repeats));
}

}  // namespace
}  // namespace bpms::test
