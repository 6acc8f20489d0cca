#include "plant/plant.h"

#include "plant/language/attributes.h"

namespace bpms {
namespace {
std::unique_ptr<OrganFunction> copy(const std::unique_ptr<OrganFunction>& function) {
  return function ? function->clone() : nullptr;
}
}  // namespace

char letter(OrganKind kind) {
  return organ_letters[static_cast<std::size_t>(kind)];
}

std::string organ_name(OrganKind kind) {
  constexpr const char* names[] = {"bud", "stem", "leaf", "head", "rotation", "compound"};
  return names[static_cast<std::size_t>(kind)];
}

OrganAttributes::OrganAttributes() = default;
OrganAttributes::OrganAttributes(OrganAttributes&&) noexcept = default;
OrganAttributes& OrganAttributes::operator=(OrganAttributes&&) noexcept = default;
OrganAttributes::~OrganAttributes() = default;

OrganAttributes::OrganAttributes(const OrganAttributes& other)
    : material(other.material),
      senescent_material(other.senescent_material),
      properties(other.properties),
      length_m(other.length_m),
      width_m(other.width_m),
      radius_m(other.radius_m),
      senescent(other.senescent),
      joint(other.joint),
      inclination(other.inclination),
      azimuth(other.azimuth),
      twist(other.twist),
      f_inclination(copy(other.f_inclination)),
      f_azimuth(copy(other.f_azimuth)),
      f_twist(copy(other.f_twist)),
      f_curvature(copy(other.f_curvature)),
      f_width(copy(other.f_width)),
      section(other.section),
      midrib_width(other.midrib_width),
      midrib_height(other.midrib_height) {}

OrganAttributes& OrganAttributes::operator=(const OrganAttributes& other) {
  OrganAttributes copied(other);
  return *this = std::move(copied);
}

}  // namespace bpms
