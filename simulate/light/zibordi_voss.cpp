#include "simulate/light/zibordi_voss.h"

#include <cmath>

#include "core/units.h"

namespace bpms::zibordi_voss {

Depths depths(const Atmosphere& a, double wavelength_nm, double k_ozone, double k_water, double k_gas) {
  const double um = wavelength_nm / 1000;
  Depths out;
  out.rayleigh = a.rayleigh_above * a.rayleigh[0] *
                 std::pow(um, -(a.rayleigh[1] + a.rayleigh[2] * um + a.rayleigh[3] / um));
  out.aerosol = a.aerosol_above * a.beta * std::pow(um, -a.alpha);
  out.ozone = a.ozone_above * a.ozone_cm * k_ozone;
  const double water = a.water_above * a.water_cm * k_water;
  out.water = 0.2385 * water / std::pow(1 + 20.07 * water, 0.45);
  const double gas = a.rayleigh_above * k_gas;  // mixed as the air is
  out.gas = 1.41 * gas / std::pow(1 + 118.93 * gas, 0.45);
  return out;
}

double rayleigh_above(double height) {
  return std::exp(-0.1188 * height - 0.00116 * height * height);
}
double aerosol_above(double height, double scale_height) {
  return std::exp(-height / scale_height);
}
double ozone_above(double height, double peak, double width) {
  return (1 + std::exp(-peak / width)) / (1 + std::exp((height - peak) / width));
}
double water_above(double height, double water_cm, double dew_point_c) {
  const double rate = std::exp(-(std::log(water_cm) - 0.061 * dew_point_c + 0.715) / 0.983);
  return std::exp(-rate * height);
}

double air_mass(double zenith_deg) {
  return 1 / (std::cos(radians(zenith_deg)) + 0.15 * std::pow(93.885 - zenith_deg, -1.253));
}

double sun_distance_factor(double day_of_year) {
  const double nearer = 1 + 0.01672 * std::cos(2 * pi * (day_of_year - 3) / 365);
  return nearer * nearer;
}

ClearSky::ClearSky(const Atmosphere& atmosphere, const Depths& depths, double sun_zenith,
                   double surface_albedo)
    : aerosol_(atmosphere.phase), mu0_(std::cos(sun_zenith)), albedo_(surface_albedo) {
  const double aerosol = atmosphere.aerosol_albedo * depths.aerosol;
  scattering_ = depths.rayleigh + aerosol;
  absorbing_ = depths.total() - scattering_;
  rayleigh_part_ = scattering_ > 0 ? depths.rayleigh / scattering_ : 1;
  // Of Rayleigh's phase function 0, of Henyey and Greenstein's 3g.
  p1_ = (1 - rayleigh_part_) * 3 * (aerosol_.weight * aerosol_.g1 + (1 - aerosol_.weight) * aerosol_.g2);
}

double ClearSky::henyey_greenstein(double g, double cos_psi) const {
  return (1 - g * g) / std::pow(1 + g * g - 2 * g * cos_psi, 1.5);
}

double ClearSky::phase(double cos_psi) const {
  const double aerosol = aerosol_.weight * henyey_greenstein(aerosol_.g1, cos_psi) +
                         (1 - aerosol_.weight) * henyey_greenstein(aerosol_.g2, cos_psi);
  return rayleigh_part_ * 0.75 * (1 + cos_psi * cos_psi) + (1 - rayleigh_part_) * aerosol;
}

double ClearSky::reflected(double mu) const {
  return 1 + 1.5 * mu + (1 - 1.5 * mu) * (mu > 0 ? std::exp(-scattering_ / mu) : 0);
}

double ClearSky::radiance(double mu, double cos_psi) const {
  if (!(scattering_ > 0)) return 0;
  const double down = mu > 0 ? std::exp(-scattering_ / mu) : 0, down0 = std::exp(-scattering_ / mu0_);
  // s1, smooth at mu = mu0: with z = ts (1/mu0 - 1/mu), exp(-ts/mu) - exp(-ts/mu0) is the smaller of the two
  // times expm1 of the difference.
  double s1 = 0.25 * down0 / mu0_;
  if (mu > 0) {
    const double z = scattering_ * (mu - mu0_) / (mu * mu0_);
    const double slope = std::abs(z) < 1e-12 ? 1 : z > 0 ? -std::expm1(-z) / z : std::expm1(z) / z;
    s1 = 0.25 * (z > 0 ? down : down0) * slope * scattering_ / (mu * mu0_);
  }
  const double sum = ((1 - albedo_) * reflected(mu) + 2 * albedo_) * reflected(mu0_) /
                         (4 + (3 - p1_) * (1 - albedo_) * scattering_) -
                     0.5 * (down + down0) + (phase(cos_psi) - (3 + p1_) * mu * mu0_) * s1;
  return mu0_ / pi * std::exp(-absorbing_ / mu0_) * sum;
}

}  // namespace bpms::zibordi_voss
