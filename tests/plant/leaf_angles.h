// Leaf angle distributions as tabulated (de Wit 1965, Campbell 1990), by Gauss-Legendre quadrature to four
// digits, and facets that have them.
#pragma once
#include <cmath>
#include <functional>

#include "core/units.h"
#include "plant/structure/de_wit.h"
#include "plant/structure/orientation.h"

namespace bpms::test {

inline constexpr double table_angles_deg[] = {0, 15, 30, 45, 57.5, 60, 75, 90};
struct LeafAngleRow {
  double mean_deg, sd_deg;
  double g[8];  // at table_angles_deg
  double mean_cos2;
};
struct DeWitRow {
  LeafAngles angles;
  LeafAngleRow is;
};
inline constexpr DeWitRow de_wit_table[] = {
    {LeafAngles::planophile, {26.76, 18.50, {.8488, .8201, .7381, .6154, .4969, .4729, .3409, .2702}, .7500}},
    {LeafAngles::erectophile,
     {63.24, 18.50, {.4244, .4316, .4514, .4794, .5041, .5088, .5316, .5404}, .2500}},
    {LeafAngles::plagiophile,
     {45.00, 16.27, {.6791, .6567, .5990, .5295, .4803, .4725, .4408, .4323}, .5000}},
    {LeafAngles::extremophile,
     {45.00, 32.94, {.5942, .5950, .5905, .5653, .5206, .5092, .4317, .3783}, .5000}},
    {LeafAngles::uniform, {45.00, 25.98, {.6366, .6258, .5947, .5474, .5005, .4908, .4363, .4053}, .5000}},
    {LeafAngles::spherical, {57.30, 21.56, {.5, .5, .5, .5, .5, .5, .5, .5}, .3333}},
};
struct EllipsoidalRow {
  double chi;
  LeafAngleRow is;
};
inline constexpr EllipsoidalRow ellipsoidal_table[] = {
    {0.5, {72.08, 15.51, {.2925, .3206, .3870, .4625, .5179, .5274, .5702, .5851}, .1383}},
    {2, {38.48, 23.08, {.7245, .7061, .6531, .5728, .4949, .4792, .3970, .3623}, .5988}},
    {3, {28.18, 21.13, {.8280, .8030, .7302, .6171, .5021, .4780, .3420, .2760}, .7380}},
};

// `count` facets at the quantiles of a distribution, azimuths by the golden angle.
inline FacetOrientation facets_at_quantiles(const std::function<double(double)>& quantile, int count) {
  FacetOrientation out;
  for (int i = 0; i < count; ++i) {
    const double t = quantile((i + 0.5) / count), azimuth = 2.399963229728653 * i;
    out.add({std::sin(t) * std::cos(azimuth), std::sin(t) * std::sin(azimuth), std::cos(t)});
  }
  return out;
}

}  // namespace bpms::test
