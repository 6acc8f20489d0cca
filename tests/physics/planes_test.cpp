// Bare planes of every formula, and of two materials.
#include "simulate/materials/hapke.h"
#include "simulate/materials/rpv.h"
#include "simulate/materials/verstraete_pinty_dickinson.h"
#include "tests/physics/physics.h"

namespace bpms::test {
namespace {

constexpr double plane_sza = 40, plane_saa = 120;
struct PlaneView {
  double vza, vaa;
};
constexpr PlaneView plane_views[] = {{0, 0}, {40, 120}, {40, 300}, {60, 75}, {20, 210}, {75, 0}};

Eigen::Vector3d towards_of(double zenith_deg, double azimuth_deg) {
  return direction_from_angles(radians(zenith_deg), radians(azimuth_deg), Domain{});
}

std::string list_of_views() {
  std::string list;
  for (const PlaneView& view : plane_views) list += fmt::format("[{}, {}], ", view.vza, view.vaa);
  return views("[" + list + "]");
}

// A plane is met once, by a ray of given direction, under a sun of given direction: no variance, and only the
// rounding of 32-bit directions.
template <class Formula>
void expect_plane(const TemporaryFolder& folder, const std::string& soil, Formula formula) {
  const SceneText scene{.soil = soil,
                        .sun = sun_at(plane_sza, plane_saa),
                        .sensor = list_of_views(),
                        .sampling = "samples = 64"};
  const SensorResult result = run_of(folder, scene);
  for (std::size_t view = 0; view < std::size(plane_views); ++view) {
    const double expected = formula(reflection_angles(
        towards_of(plane_views[view].vza, plane_views[view].vaa), towards_of(plane_sza, plane_saa)));
    EXPECT_NEAR(result.radiance[0].value[view], expected, 1e-5 * expected) << soil << "view " << view;
  }
}

TEST(BarePlane, OfRpvHasItsBrf) {
  expect_plane(TemporaryFolder(), "type = \"rpv\"\nrho0 = 0.08\nk = 0.75\ntheta = -0.1\nrhoc = 0.2\n",
               [](const ReflectionAngles& at) {
                 return rpv_brf({0.08, 0.75, -0.1, 0.2}, at);
               });
}

TEST(BarePlane, OfHapkeHasItsBrf) {
  expect_plane(TemporaryFolder(),
               "type = \"hapke\"\nw = 0.6\nb0 = 0.8\nh = 0.1\nphase = \"henyey_greenstein\"\n"
               "asymmetry = -0.2\n",
               [](const ReflectionAngles& at) {
                 return hapke_brf({0.6, 0.8, 0.1, {PhaseFunction::henyey_greenstein, -0.2, 0, 0}}, at);
               });
}

// Not reciprocal: this fails where sun and view are taken for each other.
TEST(BarePlane, OfVerstraetePintyDickinsonHasItsBrf) {
  VpdParameters p{.w = 0.6, .radius_m = 0.05, .density = 2};
  set_goudriaan(p, 0.2);
  p.phase = {PhaseFunction::legendre, 0, 0.2, 0.1};
  expect_plane(TemporaryFolder(),
               "type = \"verstraete_pinty_dickinson\"\nw = 0.6\nsunfleck_radius_m = 0.05\n"
               "area_density_m2_m3 = 2.0\nchi = 0.2\nphase = \"legendre\"\na1 = 0.2\na2 = 0.1\n",
               [&](const ReflectionAngles& at) { return vpd_brf(p, at); });
}

// A table that is linear in each of its angles by itself, the same from all sides at nadir.
TEST(BarePlane, OfATableHasItsBrf) {
  const TemporaryFolder folder;
  const auto linear = [](double light_deg, double view_deg, double azimuth_deg) {
    return 0.1 + 1e-3 * light_deg + 5e-4 * view_deg + 3e-6 * view_deg * azimuth_deg;
  };
  std::string rows = "theta_i_deg,theta_r_deg,delta_phi_deg,brf\n";
  for (const double light : {0.0, 30.0, 60.0, 90.0})
    for (const double view : {0.0, 45.0, 90.0})
      for (const double azimuth : {0.0, 90.0, 180.0})
        rows += fmt::format("{},{},{},{}\n", light, view, azimuth, linear(light, view, azimuth));
  folder.write("brf.csv", rows);
  expect_plane(folder, "type = \"tabulated\"\nfile = \"brf.csv\"\n", [&](const ReflectionAngles& at) {
    const double azimuth = degrees(std::acos(at.cos_azimuth));
    return linear(degrees(std::acos(at.mu_light)), degrees(std::acos(at.mu_view)), azimuth);
  });
}

// Every direction meets the plane, whatever brings its rays down to it.
TEST(BarePlane, IsSeenFromEveryDirection) {
  const TemporaryFolder folder;
  const SceneText scene{.soil = lambertian("0.3"),
                        .sun = sun_at(40, 120),
                        .sensor = principal_plane("{ from = -84, to = 84, step = 2 }"),
                        .sampling = "samples = 32"};
  const SensorResult result = run_of(folder, scene);
  ASSERT_EQ(result.samples.size(), 85u);
  for (std::size_t view = 0; view < 85; ++view)
    EXPECT_NEAR(result.radiance[0].value[view], 0.3, 1e-6) << "view " << view;
}

// The albedo camera over a plane: the integral of its BRF.
TEST(BarePlane, OfRpvHasItsDirectionalAlbedo) {
  const TemporaryFolder folder;
  const SceneText scene{.soil = "type = \"rpv\"\nrho0 = 0.2\nk = 0.6\ntheta = -0.2\nrhoc = 0.5\n",
                        .sun = sun_at(plane_sza, plane_saa),
                        .sensor = albedo_down,
                        .sampling = "samples = 65536"};
  constexpr int steps = 500;
  double albedo = 0;
  for (int i = 0; i < steps; ++i)
    for (int k = 0; k < steps; ++k) {
      const double zenith = std::asin(std::sqrt((i + 0.5) / steps));
      albedo += rpv_brf({0.2, 0.6, -0.2, 0.5},
                        reflection_angles(towards_of(degrees(zenith), 360 * (k + 0.5) / steps),
                                          towards_of(plane_sza, plane_saa))) /
                (steps * steps);
    }
  // Equal cells of the projected hemisphere; towards the horizon the BRF grows as mu^(k - 1), whose midpoint
  // rule is good to some steps^-1.2 of it: 2e-4, taken into the error.
  expect_agree(estimate_of(run_of(folder, scene)), {albedo, 2e-4 * albedo}, 0.005, "DHR");
}

constexpr const char* halves = R"([materials.dark]
type = "lambertian"
reflectance = 0.2
[materials.bright]
type = "lambertian"
reflectance = 0.6
)";

// West dark, east bright; the mean by area, and each where it is.
TEST(MaterialMap, IsWhereItsPictureSays) {
  const TemporaryFolder folder;
  folder.write("sheet.obj", sheet_obj(0.2));
  folder.write("halves.pgm", "P2\n4 1\n255\n0 1 1 1\n");
  SceneText scene{.leaf = "type = \"map\"\nfile = \"halves.pgm\"\nmaterials = [\"dark\", \"bright\"]",
                  .mesh = "sheet.obj",
                  .sun = sun_at(40, 120),
                  .sensor = views("[[0, 0], [45, 30]]"),
                  .sampling = "samples = 65536"};
  const SensorResult whole = run_of(folder, scene, halves);
  for (std::size_t view = 0; view < 2; ++view)
    expect_agree(estimate_of(whole, view), {0.25 * 0.2 + 0.75 * 0.6, 0}, 0.002, fmt::format("view {}", view));
  scene.sensor =
      "name = \"plan\"\ntype = \"orthographic\"\nlocation = [0, 0, 3]\ndirection = [0, 0, -1]\n"
      "up = [0, 1, 0]\nwidth_m = 2\nwidth_px = 4\nheight_px = 4\n";
  scene.sampling = "samples = 64";
  const SensorResult plan = run_of(folder, scene, halves);
  for (std::size_t pixel = 0; pixel < 16; ++pixel)
    EXPECT_NEAR(plan.radiance[0].value[pixel], pixel % 4 == 0 ? 0.2 : 0.6, 1e-6) << "pixel " << pixel;
}

// A hole in a black sheet over a plane: what shines through is seen through.
TEST(MaterialMap, CutsOut) {
  const TemporaryFolder folder;
  folder.write("sheet.obj", sheet_obj(1e-5));
  folder.write("hole.pgm", "P2\n4 2\n255\n0 0 1 1\n0 0 1 1\n");
  SceneText scene{.leaf = "type = \"map\"\nfile = \"hole.pgm\"\nmaterials = [\"black\", \"hole\"]",
                  .soil = lambertian("0.5"),
                  .mesh = "sheet.obj",
                  .sun = sun_at(40, 120),
                  .sensor = views("[[0, 0], [45, 30]]"),
                  .sampling = "samples = 65536"};
  const SensorResult result = run_of(folder, scene,
                                     "[materials.black]\ntype = \"lambertian\"\nreflectance = "
                                     "0\n[materials.hole]\ntype = \"transparent\"\n");
  for (std::size_t view = 0; view < 2; ++view)
    expect_agree(estimate_of(result, view), {0.25, 0}, 0.002, fmt::format("view {}", view));
}

TEST(Bump, OfNoHeightIsNone) {
  const TemporaryFolder folder;
  SceneText scene = mixed_canopy(folder);
  folder.write("sheet.obj", sheet_obj(0.2, 0.7));
  folder.write("flat.pgm", "P2\n2 2\n255\n7 7\n7 7\n");
  scene.discs.clear();
  scene.mesh = "sheet.obj";
  scene.sun = sun_at(40, 120);
  scene.sensor = views("[[0, 0], [45, 30]]");
  scene.sampling = "samples = 4096";
  const SensorResult without = run_of(folder, scene);
  scene.leaf += "bump = { file = \"flat.pgm\", height_m = 0.01 }\n";
  const SensorResult with = run_of(folder, scene);
  for (std::size_t view = 0; view < 2; ++view)
    EXPECT_NEAR(with.radiance[0].value[view], without.radiance[0].value[view], 1e-6) << "view " << view;
}

}  // namespace
}  // namespace bpms::test
