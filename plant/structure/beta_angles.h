// The beta distribution of leaf angles (Goel & Strebel 1984): of x = 2 t / pi in [0, 1],
//   density  (1 - x)^(mu - 1) x^(nu - 1) / B(mu, nu)
// so that mu large means flat leaves. Fitted by the mean and the variance of x.
#pragma once
#include <optional>

namespace bpms {

struct BetaAngles {
  double mu = 1, nu = 1;
};
double beta_angle_density(const BetaAngles& beta, double inclination);  // per radian of inclination
// Of the mean and the standard deviation of the inclination, radians; none where no beta distribution has
// them (no spread, or more than between 0 and 90 degrees alone).
std::optional<BetaAngles> fit_beta_angles(double mean, double sd);

}  // namespace bpms
