// Light that meets the smooth border of air and a clear medium of refractive index n (Fresnel), unpolarised.
#pragma once

namespace bpms {

// The part reflected of light from the air at this cosine of the angle of incidence. n >= 1.
double fresnel_reflectance(double cosine, double n);

// The part that enters of isotropic light within the cone of half-angle `cone_rad` about the normal: closed
// form of Stern 1964 (Appl. Opt. 3:111), as Allen 1973 (Appl. Opt. 12:2448) writes it. pi/2: all light.
double cone_transmittance(double cone_rad, double n);

}  // namespace bpms
