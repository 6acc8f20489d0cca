// The model of the clear sky: its limits, its parts, and what a sample of its author's program tells of it.
#include "simulate/light/zibordi_voss.h"

#include "simulate/light/curve.h"
#include "tests/light/light_text.h"

namespace bpms::test {
namespace {

namespace zv = zibordi_voss;

constexpr double sun_deg = 35;

double cos_between(double zenith, double azimuth_from_sun) {
  return std::cos(zenith) * std::cos(radians(sun_deg)) +
         std::sin(zenith) * std::sin(radians(sun_deg)) * std::cos(azimuth_from_sun);
}

struct Mix {
  double rayleigh, aerosol;
};

zv::ClearSky sky_of_depths(const Mix& mix, double albedo = 0, double aerosol_albedo = 1) {
  zv::Atmosphere atmosphere;
  atmosphere.aerosol_albedo = aerosol_albedo;
  zv::Depths depths;
  depths.rayleigh = mix.rayleigh;
  depths.aerosol = mix.aerosol;
  return {atmosphere, depths, radians(sun_deg), albedo};
}

// L -> E0 ts P / (4 pi mu). What is scattered twice is of the order ts (1/mu + 1/mu0), here at most 1e-5.
TEST(ZibordiVoss, ThinAirScattersOnce) {
  constexpr double thin = 1e-6;
  for (const Mix mix : {Mix{thin, 0}, Mix{0, thin}, Mix{0.3 * thin, 0.7 * thin}}) {
    const zv::ClearSky sky = sky_of_depths(mix);
    for (const double zenith_deg : {0.0, 20.0, sun_deg, 60.0, 80.0})
      for (const double azimuth_deg : {0.0, 90.0, 180.0}) {
        const double mu = std::cos(radians(zenith_deg)),
                     psi = cos_between(radians(zenith_deg), radians(azimuth_deg));
        const double once = thin * sky.phase(psi) / (4 * pi * mu);
        EXPECT_NEAR(sky.radiance(mu, psi), once, 2e-5 * once) << zenith_deg << " " << azimuth_deg;
      }
  }
}

// Mean 1 over the sphere; p1 is 1.5 times the integral of P cos sin.
TEST(ZibordiVoss, PhaseFunctionIsNormal) {
  const zv::ClearSky sky = sky_of_depths({0.1, 0.2});
  constexpr int steps = 20000;
  double mean = 0, first = 0;
  for (int i = 0; i < steps; ++i) {
    const double psi = pi * (i + 0.5) / steps;
    const double part = sky.phase(std::cos(psi)) * std::sin(psi) * pi / steps;
    mean += 0.5 * part;
    first += 1.5 * part * std::cos(psi);
  }
  EXPECT_NEAR(mean, 1, 1e-6);
  EXPECT_NEAR(first, sky.p1(), 1e-6);
}

TEST(ZibordiVoss, IsSmoothWhereTheSunStands) {
  const zv::ClearSky sky = sky_of_depths({0.2, 0.2}, 0.3);
  const double mu0 = std::cos(radians(sun_deg));
  const double here = sky.radiance(mu0, 0.5);
  EXPECT_TRUE(std::isfinite(here));
  for (const double off : {1e-15, 1e-12, 1e-9, 1e-6}) {
    const double both = 0.5 * (sky.radiance(mu0 - off, 0.5) + sky.radiance(mu0 + off, 0.5));
    EXPECT_NEAR(both, here, 1e-10 * here) << off;
  }
  // And at the horizon.
  EXPECT_NEAR(sky.radiance(0, 0.3), sky.radiance(1e-9, 0.3), 1e-7 * here);
}

// Nothing is made: what comes down without absorption, over black ground, is less than came in.
TEST(ZibordiVoss, ScattersNoMoreThanComesIn) {
  for (const Mix mix : {Mix{0.05, 0.1}, Mix{0.3, 0}, Mix{0.1, 0.4}}) {
    const zv::ClearSky sky = sky_of_depths(mix);
    double diffuse = 0;
    constexpr int rows = 400, columns = 200;
    for (int i = 0; i < rows; ++i)
      for (int k = 0; k < columns; ++k) {
        const double zenith = pi / 2 * (i + 0.5) / rows, azimuth = 2 * pi * (k + 0.5) / columns;
        diffuse += sky.radiance(std::cos(zenith), cos_between(zenith, azimuth)) * std::cos(zenith) *
                   std::sin(zenith) * (pi / 2 / rows) * (2 * pi / columns);
      }
    const double mu0 = std::cos(radians(sun_deg));
    const double scattered = mu0 * (1 - std::exp(-(mix.rayleigh + mix.aerosol) / mu0));
    EXPECT_LT(diffuse, scattered);
    EXPECT_GT(diffuse, 0.4 * scattered);  // Rayleigh's halves go up and down, aerosol's mostly down
  }
}

TEST(ZibordiVoss, DepthsFollowTheirFormulae) {
  zv::Atmosphere atmosphere;
  const zv::Depths at = zv::depths(atmosphere, 550, 0.09, 0.02, 0.003);
  EXPECT_NEAR(at.rayleigh, 0.00838 * std::pow(0.55, -(3.916 + 0.074 * 0.55 + 0.05 / 0.55)), 1e-12);
  EXPECT_NEAR(at.aerosol, 0.1 * std::pow(0.55, -1.3), 1e-12);
  EXPECT_NEAR(at.ozone, 0.027, 1e-12);
  EXPECT_NEAR(at.water, 0.2385 * 0.028 / std::pow(1 + 20.07 * 0.028, 0.45), 1e-12);
  EXPECT_NEAR(at.gas, 1.41 * 0.003 / std::pow(1 + 118.93 * 0.003, 0.45), 1e-12);
}

// The table of parameters states a rate of 0.639 per km for the default water and dew point.
TEST(ZibordiVoss, LessIsLeftAboveAnAltitude) {
  EXPECT_NEAR(-std::log(zv::water_above(1, 1.4, 10.02)), 0.639, 5e-4);
  EXPECT_EQ(zv::rayleigh_above(0), 1);
  EXPECT_EQ(zv::ozone_above(0, 20, 5), 1);
  EXPECT_NEAR(zv::ozone_above(20, 20, 5), 0.5 * (1 + std::exp(-4)), 1e-12);
  EXPECT_NEAR(zv::aerosol_above(0.97, 0.97), std::exp(-1), 1e-12);
}

TEST(ZibordiVoss, TheEarthIsNearestInJanuary) {
  EXPECT_NEAR(zv::sun_distance_factor(3), 1.01672 * 1.01672, 1e-12);
  EXPECT_NEAR(zv::sun_distance_factor(185.5), 0.98328 * 0.98328, 1e-12);
}

// What the sample says of itself: columns 2, 4 and 10 give the sun's zenith, column 7 the optical depth; the
// transmittances of columns 8 and 9, and the irradiance above the atmosphere, follow.
TEST(ZibordiVoss, TransmittanceOfTheSample) {
  BPMS_NEED_DATA("sky/direct.total_irradiance.all");
  const std::string folder = data_folder() + "/sky/", file = folder + "direct.total_irradiance.all";
  const auto column = [&](int number) { return read_curve(file, fmt::format("{}", number)); };
  const ColumnCurve direct = column(2), diffuse = column(4), depth = column(7), down = column(8),
                    up = column(9), percent = column(10);
  const ColumnCurve above = read_curve(folder + "E0D", "2");
  ASSERT_GT(direct.x.size(), 5u);
  const double first = direct.y[0] / down.y[0] / above.at(direct.x[0]);
  // A distance of the earth from the sun within its year.
  EXPECT_GT(first, zv::sun_distance_factor(185.5));
  EXPECT_LT(first, zv::sun_distance_factor(3));
  for (std::size_t i = 0; i < direct.x.size(); ++i) {
    const double cosine = diffuse.y[i] * (100 / percent.y[i] - 1) / direct.y[i];
    const double sun_zenith_deg = degrees(std::acos(cosine));
    // The sample's last digits: 6 of transmittance, 5 of irradiance.
    EXPECT_NEAR(std::exp(-depth.y[i] * zv::air_mass(sun_zenith_deg)), down.y[i], 2e-6);
    EXPECT_NEAR(std::exp(-depth.y[i]), up.y[i], 1e-6);
    EXPECT_NEAR(direct.y[i] / down.y[i] / above.at(direct.x[i]), first, 2e-5);
  }
}

}  // namespace
}  // namespace bpms::test
