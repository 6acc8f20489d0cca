// The attributes of the plant language: one table that the reader and the writer share.
#pragma once
#include <string_view>
#include <vector>

#include "plant/plant.h"

namespace bpms {

inline constexpr std::string_view organ_letters = "bslh+c";  // in the order of OrganKind

// a_length 10.0: a size in the file's unit, or an angle in degrees.
struct ConstantAttribute {
  std::string_view name;
  double OrganAttributes::*member;
  bool angle;
  std::string_view letters;  // organs that have it
};
// f_inclination n 0 0 1 180: angles in degrees; the width is a fraction.
struct FunctionAttribute {
  std::string_view name;
  std::unique_ptr<OrganFunction> OrganAttributes::*member;
  bool angle;
  std::string_view letters;
};

// senescent_material straw: a name.
struct NameAttribute {
  std::string_view name;
  std::string OrganAttributes::*member;
  std::string_view letters;
};
// a_senescent 0.3: a number without a unit.
struct NumberAttribute {
  std::string_view name;
  double OrganAttributes::*member;
  double most;  // the least is 0
  std::string_view letters;
};

inline constexpr NameAttribute name_attributes[] = {
    {"material", &OrganAttributes::material, "bslh"},
    {"senescent_material", &OrganAttributes::senescent_material, "l"},
    {"section", &OrganAttributes::section, "l"},
};
inline constexpr NumberAttribute number_attributes[] = {
    {"a_senescent", &OrganAttributes::senescent, 1, "l"},
    {"a_joint", &OrganAttributes::joint, 100, "s"},
    {"a_midrib_width", &OrganAttributes::midrib_width, 1, "l"},
    {"a_midrib_height", &OrganAttributes::midrib_height, 1, "l"},
};
inline constexpr ConstantAttribute constant_attributes[] = {
    {"a_length", &OrganAttributes::length_m, false, "slh"},
    {"a_width", &OrganAttributes::width_m, false, "l"},
    {"a_radius", &OrganAttributes::radius_m, false, "bsh"},
    {"a_inclination", &OrganAttributes::inclination, true, "bslh+c"},
    {"a_azimuth", &OrganAttributes::azimuth, true, "bslh+c"},
    {"a_twist", &OrganAttributes::twist, true, "bslh+c"},
};
inline constexpr FunctionAttribute function_attributes[] = {
    {"f_inclination", &OrganAttributes::f_inclination, true, "slh"},
    {"f_azimuth", &OrganAttributes::f_azimuth, true, "slh"},
    {"f_twist", &OrganAttributes::f_twist, true, "slh"},
    {"f_curvature", &OrganAttributes::f_curvature, true, "l"},
    {"f_width", &OrganAttributes::f_width, false, "slh"},
};
inline constexpr std::string_view property_prefix = "p_", property_letters = "bslhc";

// The attributes that are not as they are when absent, in the order in which they are written.
struct AttributeLine {
  std::string name, value;
  std::string unit;  // of the value: of lengths the plant's own, of angles "deg", else ""
};
std::vector<AttributeLine> attribute_lines(const OrganAttributes& attributes, const std::string& unit);
// A property's value as it is written: in quotes where it must be.
std::string property_text(std::string_view value);

bool is_attribute_name(std::string_view name);

}  // namespace bpms
