// Leaf angle distributions of de Wit (1965): densities of the leaf inclination, that is the zenith of the
// upper normal, azimuths uniform. All but the spherical one are 2/pi (1 + a cos 2t + b cos 4t).
#pragma once
#include <array>
#include <string>

namespace bpms {

enum class LeafAngles { spherical, planophile, erectophile, plagiophile, extremophile, uniform };
inline constexpr std::array all_leaf_angles{LeafAngles::spherical,    LeafAngles::planophile,
                                            LeafAngles::erectophile,  LeafAngles::plagiophile,
                                            LeafAngles::extremophile, LeafAngles::uniform};
std::string name_of(LeafAngles angles);

// Density of the inclination in [0, pi/2], per radian.
double leaf_angle_density(LeafAngles angles, double inclination);
// The probability of an inclination below this one, and the inclination at cumulative probability u.
double leaf_angle_cumulative(LeafAngles angles, double inclination);
double leaf_angle_quantile(LeafAngles angles, double u);
// G(t): projection of one-sided unit leaf area on the plane normal to a direction of zenith t.
double g_function(LeafAngles angles, double zenith);

}  // namespace bpms
