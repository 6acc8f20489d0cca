// Maps of the sky: what they hold, what falls onto the horizontal, and how directions are drawn from them.
#include "simulate/light/sky_map.h"

#include <gmock/gmock.h>

#include <functional>

#include "core/random.h"
#include "core/units.h"
#include "tests/chi_square.h"

namespace bpms::test {
namespace {

using Radiance = std::function<double(double zenith, double azimuth, std::size_t band)>;

SkyMap map_of(std::size_t zeniths, std::size_t azimuths, std::size_t bands, const Radiance& radiance) {
  std::vector<float> values;
  for (std::size_t row = 0; row < zeniths; ++row)
    for (std::size_t column = 0; column < azimuths; ++column)
      for (std::size_t band = 0; band < bands; ++band)
        values.push_back(static_cast<float>(
            radiance(pi / 2 * static_cast<double>(row) / static_cast<double>(zeniths - 1),
                     2 * pi * static_cast<double>(column) / static_cast<double>(azimuths), band)));
  return SkyMap(zeniths, azimuths, bands, std::move(values));
}

Eigen::Vector3f towards(double zenith, double azimuth) {
  return Eigen::Vector3d(std::sin(zenith) * std::sin(azimuth), std::sin(zenith) * std::cos(azimuth),
                         std::cos(zenith))
      .cast<float>();
}

// Bright about the south-west at 50 degrees, black in part of the north, the second band of another shape.
double uneven(double zenith, double azimuth, std::size_t band) {
  if (band == 1) return 3 + std::cos(azimuth);
  const double off = std::hypot(zenith - radians(50), 0.5 * std::sin(0.5 * (azimuth - radians(225))));
  return off > 0.6 ? 0 : 0.02 + std::exp(-20 * off * off);
}

TEST(SkyMap, IsotropicGivesPi) {
  const SkyMap map = map_of(10, 4, 2, [](double, double, std::size_t band) { return band == 0 ? 1.0 : 2.0; });
  EXPECT_NEAR(map.irradiance()[0], pi, 1e-12);
  EXPECT_NEAR(map.irradiance()[1], 2 * pi, 1e-12);
}

// cos^n zenith: 2 pi / (n + 2). Linear interpolation of steps h is off by at most h^2 / 8 times the curvature
// of at most n: 1 degree, 4e-5 n.
TEST(SkyMap, PowersOfTheCosineHaveClosedForms) {
  for (const int n : {1, 2, 3}) {
    const SkyMap map =
        map_of(91, 1, 1, [n](double zenith, double, std::size_t) { return std::pow(std::cos(zenith), n); });
    EXPECT_NEAR(map.irradiance()[0], 2 * pi / (n + 2), 4e-5 * n * pi);
  }
}

TEST(SkyMap, IsLinearBetweenItsPointsAndPeriodic) {
  const SkyMap map = map_of(4, 8, 2, uneven);
  std::vector<float> out(2), a(2), b(2);
  for (std::size_t row = 1; row < 4; ++row)
    for (std::size_t column = 0; column < 8; ++column) {
      const double zenith = radians(30.0 * static_cast<double>(row));
      const double azimuth = radians(45.0 * static_cast<double>(column));
      map.radiance(towards(zenith, azimuth), out);
      EXPECT_NEAR(out[1], uneven(zenith, azimuth, 1), 1e-5);  // 32-bit angles
      const double next = azimuth + radians(45);
      map.radiance(towards(zenith, azimuth + radians(15)), out);
      map.radiance(towards(zenith, azimuth), a);
      map.radiance(towards(zenith, next), b);
      for (std::size_t band = 0; band < 2; ++band) EXPECT_NEAR(out[band], (2 * a[band] + b[band]) / 3, 2e-6);
    }
}

TEST(SkyMap, LooksByCompass) {
  const SkyMap map = map_of(3, 4, 1, [](double, double azimuth, std::size_t) { return azimuth; });
  std::vector<float> out(1);
  map.radiance({1, 0, 0}, out);
  EXPECT_NEAR(out[0], pi / 2, 1e-5);
  map.radiance({0, -1, 0}, out);
  EXPECT_NEAR(out[0], pi, 1e-5);
}

// By a fine quadrature over each cell.
TEST(SkyMap, DensityIntegratesToOne) {
  for (const bool black : {false, true}) {
    const SkyMap map =
        map_of(10, 12, 2, black ? [](double, double, std::size_t) { return 0.0; } : Radiance(uneven));
    double sum = 0;
    constexpr int rows = 9 * 40, columns = 12 * 10;
    for (int i = 0; i < rows; ++i)
      for (int k = 0; k < columns; ++k) {
        const double zenith = pi / 2 * (i + 0.5) / rows;
        sum += static_cast<double>(map.pdf(towards(zenith, 2 * pi * (k + 0.5) / columns))) *
               std::sin(zenith) * (pi / 2 / rows) * (2 * pi / columns);
      }
    EXPECT_NEAR(sum, 1, 1e-5);
  }
}

// Classes: parts of the hemisphere that do not follow the map's own cells.
TEST(SkyMap, DirectionsFollowTheirDensity) {
  const SkyMap map = map_of(10, 12, 2, uneven);
  constexpr int rings = 14, slices = 17, fine = 24, draws = 200000;
  std::vector<double> expected(rings * slices), counts(rings * slices);
  for (int i = 0; i < rings * fine; ++i)
    for (int k = 0; k < slices * fine; ++k) {
      const double zenith = pi / 2 * (i + 0.5) / (rings * fine);
      expected[static_cast<std::size_t>(i / fine * slices + k / fine)] +=
          draws * static_cast<double>(map.pdf(towards(zenith, 2 * pi * (k + 0.5) / (slices * fine)))) *
          std::sin(zenith) * (pi / 2 / (rings * fine)) * (2 * pi / (slices * fine));
    }
  Philox random(9);
  for (int i = 0; i < draws; ++i) {
    const double u = random.uniform(), v = random.uniform();
    const Eigen::Vector3f to = map.sample(u, v);
    EXPECT_NEAR(to.norm(), 1, 1e-6);
    EXPECT_GT(map.pdf(to), 0);
    const double zenith = std::acos(std::min(1.0, static_cast<double>(to.z())));
    const double azimuth = std::atan2(to.x(), to.y());
    const int ring = std::min(rings - 1, static_cast<int>(zenith / (pi / 2) * rings));
    const int slice = std::min(
        slices - 1, static_cast<int>((azimuth < 0 ? azimuth + 2 * pi : azimuth) / (2 * pi) * slices));
    ++counts[static_cast<std::size_t>(ring * slices + slice)];
  }
  // The map's cells cut through the classes: their expected counts are known to some 1e-3.
  EXPECT_LT(chi_square(counts, expected).z(), 4);
}

TEST(SkyMap, MonteCarloOfItsSamplesIsTheIrradiance) {
  const SkyMap map = map_of(10, 12, 2, uneven);
  constexpr int draws = 100000;
  std::vector<float> seen(2);
  std::array<double, 2> sum{}, squares{};
  Philox random(10);
  for (int i = 0; i < draws; ++i) {
    const double u = random.uniform(), v = random.uniform();
    const Eigen::Vector3f to = map.sample(u, v);
    map.radiance(to, seen);
    for (std::size_t band = 0; band < 2; ++band) {
      const double value = static_cast<double>(seen[band] * to.z() / map.pdf(to));
      sum[band] += value / draws;
      squares[band] += value * value / draws;
    }
  }
  for (std::size_t band = 0; band < 2; ++band) {
    const double error = std::sqrt((squares[band] - sum[band] * sum[band]) / draws);
    EXPECT_LT(error, 0.02 * sum[band]);
    EXPECT_NEAR(sum[band], map.irradiance()[band], 4 * error);
  }
}

}  // namespace
}  // namespace bpms::test
