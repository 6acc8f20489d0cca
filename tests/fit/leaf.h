// A leaf with known functions for the tests of fit.
#pragma once
#include "core/units.h"
#include "fit/fit.h"
#include "fit/synthetic.h"

namespace bpms::test {

inline std::unique_ptr<OrganFunction> angles(char code, const std::vector<double>& degrees_or_pairs) {
  return make_organ_function(code, degrees_or_pairs, radians(1), {});
}

// Arching, bent sideways by an azimuth whose mean is zero, twisted, with a spindle-shaped blade.
inline SyntheticLeaf arching_leaf() {
  SyntheticLeaf leaf;
  leaf.organ.length_m = 0.25;
  leaf.organ.width_m = 0.015;
  leaf.organ.f_inclination = angles('p', {15, 40, 30});
  leaf.organ.f_azimuth = angles('p', {-10, 20});
  leaf.organ.f_twist = angles('p', {5, -40});
  leaf.organ.f_width = make_organ_function('p', {0.6, 1.8, -2.2}, 1, {});
  leaf.direction = radians(35);
  leaf.base_m = {0.1, -0.2, 0.3};
  return leaf;
}

inline FitOptions exactly(const std::string& request) {
  FitOptions options;
  options.functions = parse_function_request(request);
  return options;
}

}  // namespace bpms::test
