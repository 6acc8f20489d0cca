// Single scattering of canopies of random discs against turbid media (Ross 1981; Shultz & Myneni 1988):
//   BRF1 = Gamma / (mu mu0) (1 - exp(-(K + k) LAI)) / (K + k),  K = G(sun) / mu0,  k = G(view) / mu.
// Discs hide light and sight together (the hot spot): for a radius r the joint gap is larger by a factor
// 1 + O(r), so BRF1 at r and r/2 give the turbid value as 2 BRF1(r/2) - BRF1(r). In the hot spot itself
// light and sight share one gap, whatever the radius: exp(-K z) takes the place of exp(-(K + k) z).
#include <gmock/gmock.h>

#include "core/units.h"
#include "tests/simulate/scene_text.h"
#include "tests/simulate/spread.h"

namespace bpms::test {
namespace {

constexpr double rho = 0.5, tau = 0.3, lai = 1.5, sza = 30, saa = 20, bottom_m = 0.02;
struct View {
  double vza, vaa;
};
constexpr View views_far_from_the_sun[] = {{0, 0}, {50, 200}, {50, 110}, {65, 20}, {30, 200}};
constexpr std::size_t n_views = std::size(views_far_from_the_sun);

Eigen::Vector3d towards(const View& view) {
  return direction_from_angles(radians(view.vza), radians(view.vaa), Domain{});
}

// Gamma = mean over leaf normals of |n.s| |n.v| times rho where both look at one face, tau otherwise.
double area_scattering(LeafAngles angles, const Eigen::Vector3d& sun, const Eigen::Vector3d& view) {
  constexpr int steps = 400;
  double out = 0;
  for (int i = 0; i < steps; ++i) {
    const double inclination = leaf_angle_quantile(angles, (i + 0.5) / steps);
    for (int k = 0; k < steps; ++k) {
      const double azimuth = 2 * pi * (k + 0.5) / steps;
      const Eigen::Vector3d n(std::sin(inclination) * std::cos(azimuth),
                              std::sin(inclination) * std::sin(azimuth), std::cos(inclination));
      const double both = n.dot(sun) * n.dot(view);
      out += std::abs(both) * (both > 0 ? rho : tau) / (steps * steps);
    }
  }
  return out;
}

// For spherical leaves in closed form; beta lies between directions of propagation.
double spherical_area_scattering(const Eigen::Vector3d& sun, const Eigen::Vector3d& view) {
  const double beta = pi - std::acos(std::clamp(sun.dot(view), -1.0, 1.0));
  return (rho + tau) / (3 * pi) * (std::sin(beta) - beta * std::cos(beta)) + tau / 3 * std::cos(beta);
}

double turbid(LeafAngles angles, const View& view) {
  const Eigen::Vector3d s = towards({sza, saa}), v = towards(view);
  const double extinction =
      g_function(angles, radians(sza)) / s.z() + g_function(angles, radians(view.vza)) / v.z();
  return area_scattering(angles, s, v) / (s.z() * v.z()) * (1 - std::exp(-extinction * lai)) / extinction;
}

// BRF1 of the leaves over canopies of one radius, and in the hot spot as the last.
std::vector<Mean> disc_canopies(LeafAngles angles, double radius_m, int draws) {
  std::vector<std::vector<double>> brf(n_views + 1);
  for (int draw = 0; draw < draws; ++draw) {
    const TemporaryFolder folder;
    SceneText scene = canopy_text(folder, {.lai = lai,
                                           .radius_m = radius_m,
                                           .size_m = {1.5, 1.5},
                                           .bottom_m = bottom_m,
                                           .angles = angles,
                                           .seed = static_cast<std::uint64_t>(draw + 1)});
    scene.leaf = bilambertian(fmt::format("{}", rho), fmt::format("{}", tau));
    scene.soil = lambertian("0");
    scene.sun = sun_at(sza, saa);
    std::string list;
    for (const View& view : views_far_from_the_sun) list += fmt::format("[{}, {}], ", view.vza, view.vaa);
    scene.sensor = views(fmt::format("[{}[{}, {}]]", list, sza, saa));
    scene.sampling = "samples = 8192\nmax_order = 1";
    const SensorResult result = sensor_result(folder, scene);
    for (std::size_t view = 0; view <= n_views; ++view) brf[view].push_back(result.radiance[0].value[view]);
  }
  std::vector<Mean> out;
  for (const auto& of_view : brf) out.push_back(mean_of(of_view));
  return out;
}

void expect_turbid_limit(LeafAngles angles) {
  constexpr int draws = 10;
  const std::vector<Mean> wide = disc_canopies(angles, 0.02, draws),
                          narrow = disc_canopies(angles, 0.01, draws);
  for (std::size_t view = 0; view < n_views; ++view) {
    const double expected = turbid(angles, views_far_from_the_sun[view]);
    const double value = 2 * narrow[view].value - wide[view].value;
    const double error = std::hypot(2 * narrow[view].error, wide[view].error);
    EXPECT_LT(error, 0.015 * expected);  // small enough to bite
    EXPECT_LT(std::abs(value - expected), 4 * error)
        << "view " << view << ": " << value << " +- " << error << ", expected " << expected;
  }
  const double mu = std::cos(radians(sza)), extinction = g_function(angles, radians(sza)) / mu;
  const double hot = area_scattering(angles, towards({sza, saa}), towards({sza, saa})) / (mu * mu) *
                     (1 - std::exp(-extinction * lai)) / extinction;
  for (const Mean& found : {wide[n_views], narrow[n_views]}) {
    EXPECT_LT(found.error, 0.01 * hot);
    EXPECT_LT(std::abs(found.value - hot), 4 * found.error)
        << "hot spot: " << found.value << " +- " << found.error << ", expected " << hot;
  }
}

TEST(Turbid, AreaScatteringOfSphericalLeavesHasItsClosedForm) {
  for (const View& view : views_far_from_the_sun) {
    const Eigen::Vector3d s = towards({sza, saa}), v = towards(view);
    EXPECT_NEAR(area_scattering(LeafAngles::spherical, s, v), spherical_area_scattering(s, v), 2e-6);
  }
}

TEST(Turbid, SphericalLeavesScatterOnceAsTheClosedFormSays) {
  expect_turbid_limit(LeafAngles::spherical);
}
TEST(Turbid, PlanophileLeavesScatterOnceAsTheIntegralSays) {
  expect_turbid_limit(LeafAngles::planophile);
}

}  // namespace
}  // namespace bpms::test
