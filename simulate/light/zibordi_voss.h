// The clear sky of Zibordi & Voss 1989 (Remote Sensing of Environment 27:343): spectral irradiance of the sun
// and radiance of the sky over a Lambertian surface, from optical depths of a plane-parallel atmosphere.
// With A the surface's albedo, ts the scattering and ta the absorbing optical depth, mu and mu0 the cosines
// of the zenith angles of the point of the sky and of the sun, psi the angle between them:
//   L = (E0/pi) mu0 exp(-ta/mu0) S
//   S = [((1-A) R(mu) + 2A) R(mu0)] / [4 + (3-p1)(1-A) ts] - (exp(-ts/mu) + exp(-ts/mu0)) / 2
//       + [P(psi) - (3+p1) mu mu0] s1,   s1 = (exp(-ts/mu) - exp(-ts/mu0)) / (4 (mu - mu0))
//   R(x) = 1 + 1.5x + (1 - 1.5x) exp(-ts/x),   p1 = 1.5 * integral of P cos(psi) sin(psi)
// P: Rayleigh's and a two-term Henyey-Greenstein phase function (Kattawar 1975), by their optical depths.
// Optical depths: Froehlich & Shaw 1980 (Rayleigh), Angstrom (aerosol), Leckner 1978 (ozone, water, mixed
// gases). Direct sun: E0 exp(-t m), t all of the optical depth, m the air mass after Kasten (Iqbal 1983).
#pragma once
#include <array>

namespace bpms::zibordi_voss {

struct Phase {
  double weight = 0.9618, g1 = 0.713, g2 = -0.7598;  // of the aerosol
};

struct Atmosphere {
  std::array<double, 4> rayleigh{0.00838, 3.916, 0.074, 0.050};
  double alpha = 1.3, beta = 0.1, aerosol_albedo = 0.9;  // aerosol depth beta um^-alpha
  Phase phase;
  double ozone_cm = 0.3;
  double water_cm = 1.4;
  // What is left of each above the observer.
  double rayleigh_above = 1, aerosol_above = 1, ozone_above = 1, water_above = 1;
};

// Of a single wavelength; absorption coefficients in cm-1.
struct Depths {
  double rayleigh = 0, aerosol = 0, ozone = 0, water = 0, gas = 0;
  double total() const { return rayleigh + aerosol + ozone + water + gas; }
};
Depths depths(const Atmosphere& atmosphere, double wavelength_nm, double k_ozone, double k_water,
              double k_gas);

// Heights in km.
double rayleigh_above(double height);
double aerosol_above(double height, double scale_height);
double ozone_above(double height, double peak, double width);
double water_above(double height, double water_cm, double dew_point_c);

double air_mass(double zenith_deg);
double sun_distance_factor(double day_of_year);  // of the irradiance

// The sky of one wavelength under unit irradiance from above the atmosphere, E0 = 1.
class ClearSky {
 public:
  ClearSky(const Atmosphere& atmosphere, const Depths& depths, double sun_zenith, double surface_albedo);
  double radiance(double mu, double cos_psi) const;  // mu >= 0
  double phase(double cos_psi) const;                // mean 1 over the sphere
  double p1() const { return p1_; }

 private:
  double henyey_greenstein(double g, double cos_psi) const;
  double reflected(double mu) const;  // R
  Phase aerosol_;
  double rayleigh_part_, scattering_, absorbing_, p1_, mu0_, albedo_;
};

}  // namespace bpms::zibordi_voss
