#include "fit/plant_assembly.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace bpms {
namespace {

OrganKind kind_of(const std::string& organ) {
  if (organ == "stem") return OrganKind::stem;
  if (organ == "head") return OrganKind::head;
  return OrganKind::leaf;
}

std::unique_ptr<OrganFunction> angle_function(const OrganFit& fit, const std::string& name) {
  const auto found = fit.functions.find(name);
  if (found == fit.functions.end()) return nullptr;
  return found->second.basis.function(found->second.coefficients * degrees(1), radians(1));
}

OrganAttributes attributes_of(const OrganFit& fit, const AssemblyOptions& options) {
  OrganAttributes out;
  out.material = fit.measured.organ;
  out.length_m = fit.length_m;
  out.f_inclination = angle_function(fit, "inclination");
  out.f_azimuth = angle_function(fit, "azimuth");
  const bool leaf = kind_of(fit.measured.organ) == OrganKind::leaf;
  const auto width = fit.functions.find("width");
  if (leaf) {
    out.f_twist = angle_function(fit, "twist");
    out.width_m = options.width_m;
    if (width != fit.functions.end() && fit.width_m > 0) {
      out.width_m = fit.width_m;
      out.f_width = width->second.basis.function(width->second.coefficients / fit.width_m, 1.0);
    }
  } else if (width != fit.functions.end() && fit.width_m > 0) {
    out.radius_m = fit.width_m / 2;
  }
  return out;
}

Symbol symbol(Symbol::Type type) {
  Symbol out;
  out.type = type;
  return out;
}

}  // namespace

FittedPlant assemble_plant(const std::string& name, const std::vector<OrganFit>& fits,
                           const std::vector<std::size_t>& members, const AssemblyOptions& options) {
  FittedPlant out;
  out.plant.name = name;
  out.plant.unit = options.unit;
  const OrganFit* foot = nullptr;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::size_t k : members) {
    const OrganFit& fit = fits[k];
    if (!fit.ok()) continue;
    out.organs.push_back(k);
    sum += fit.base_m;
    if (fit.measured.organ == "stem" && (foot == nullptr || fit.base_m.z() < foot->base_m.z())) foot = &fit;
  }
  if (out.organs.empty()) return out;
  out.origin_m =
      foot != nullptr ? foot->base_m : Eigen::Vector3d(sum / static_cast<double>(out.organs.size()));

  int rotations = 0;
  std::map<OrganKind, int> count;
  const auto add_organ = [&](OrganKind kind, OrganAttributes attributes) {
    Symbol s = symbol(Symbol::Type::organ);
    s.kind = kind;
    s.ordinal = kind == OrganKind::rotation ? ++rotations : ++count[kind];
    s.block = static_cast<int>(out.plant.blocks.size());
    Block block;
    block.kind = kind;
    block.number = s.ordinal;
    block.attributes = std::move(attributes);
    out.plant.word.push_back(s);
    out.plant.blocks.push_back(std::move(block));
  };
  out.plant.word.push_back(symbol(Symbol::Type::open));
  for (const std::size_t k : out.organs) {
    out.plant.word.push_back(symbol(Symbol::Type::open));
    OrganAttributes turn;
    turn.twist = fits[k].direction;
    add_organ(OrganKind::rotation, std::move(turn));
    add_organ(kind_of(fits[k].measured.organ), attributes_of(fits[k], options));
    out.plant.word.push_back(symbol(Symbol::Type::close));
  }
  out.plant.word.push_back(symbol(Symbol::Type::close));
  return out;
}

}  // namespace bpms
