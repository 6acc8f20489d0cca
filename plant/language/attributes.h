// The attributes of the plant language: one table that the reader and the writer share.
#pragma once
#include <string_view>
#include <vector>

#include "plant/plant.h"

namespace bpms {

inline constexpr std::string_view organ_letters = "bslh+";  // in the order of OrganKind

// a_length 10.0: a size in the file's unit, or an angle in degrees.
struct ConstantAttribute {
  std::string_view name;
  double OrganAttributes::*member;
  bool angle;
  std::string_view letters;  // organs that have it
  bool fraction = false;     // of another size: no unit
};
// f_inclination n 0 0 1 180: angles in degrees; the width is a fraction.
struct FunctionAttribute {
  std::string_view name;
  std::unique_ptr<OrganFunction> OrganAttributes::*member;
  bool angle;
  std::string_view letters;
};

inline constexpr ConstantAttribute constant_attributes[] = {
    {"a_length", &OrganAttributes::length_m, false, "slh"},
    {"a_width", &OrganAttributes::width_m, false, "l"},
    {"a_radius", &OrganAttributes::radius_m, false, "bsh"},
    {"a_midrib_width", &OrganAttributes::midrib_width, false, "l", true},
    {"a_midrib_height", &OrganAttributes::midrib_height, false, "l", true},
    {"a_inclination", &OrganAttributes::inclination, true, "bslh+"},
    {"a_azimuth", &OrganAttributes::azimuth, true, "bslh+"},
    {"a_twist", &OrganAttributes::twist, true, "bslh+"},
};
inline constexpr FunctionAttribute function_attributes[] = {
    {"f_inclination", &OrganAttributes::f_inclination, true, "slh"},
    {"f_azimuth", &OrganAttributes::f_azimuth, true, "slh"},
    {"f_twist", &OrganAttributes::f_twist, true, "slh"},
    {"f_curvature", &OrganAttributes::f_curvature, true, "l"},
    {"f_width", &OrganAttributes::f_width, false, "slh"},
};
inline constexpr std::string_view material_letters = "bslh";
inline constexpr std::string_view section_letters = "l";

}  // namespace bpms
