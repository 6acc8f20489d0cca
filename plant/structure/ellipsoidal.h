// The ellipsoidal leaf angle distribution (Campbell 1986, 1990): leaves are turned as the surface elements of
// a spheroid, chi = horizontal over vertical semi-axis; 1 is spherical, above it leaves lie flatter.
//   density  2 chi^3 sin t / (Lambda (cos^2 t + chi^2 sin^2 t)^2)
//   G(t)     sqrt(chi^2 cos^2 t + sin^2 t) / Lambda
// with Lambda = chi + asin(e) / e, e^2 = 1 - chi^2 below 1, and chi + ln((1 + e) / (1 - e)) / (2 e chi),
// e^2 = 1 - chi^-2 above: exact, where Campbell's 1.774 (chi + 1.182)^-0.733 approximates it.
#pragma once

namespace bpms {

double ellipsoidal_density(double chi, double inclination);  // per radian
double ellipsoidal_g(double chi, double zenith);
double ellipsoidal_mean(double chi);  // mean inclination, radians, by quadrature
// The chi of that mean inclination, between 1e-3 and 1e3 (an inclination of 0 or 90 degrees has none).
double ellipsoidal_chi(double mean_inclination);

}  // namespace bpms
