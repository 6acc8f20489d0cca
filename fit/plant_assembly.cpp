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
  }
  if (width != fit.functions.end() && fit.width_m > 0) {
    (leaf ? out.width_m : out.radius_m) = leaf ? fit.width_m : fit.width_m / 2;
    out.f_width = width->second.basis.function(width->second.coefficients / fit.width_m, 1.0);
  }
  return out;
}

// Writes the word and its blocks from left to right.
class PlantWriter {
 public:
  explicit PlantWriter(Plant& plant) : plant_(plant) {}
  void open() { plant_.word.emplace_back().type = Symbol::Type::open; }
  void close() { plant_.word.emplace_back().type = Symbol::Type::close; }
  void organ(OrganKind kind, OrganAttributes attributes) {
    Block& block = plant_.blocks.emplace_back();
    block.kind = kind;
    block.number = ++count_[kind];
    block.attributes = std::move(attributes);
    Symbol& symbol = plant_.word.emplace_back();
    symbol.type = Symbol::Type::organ;
    symbol.kind = kind;
    symbol.ordinal = count_[kind];
    symbol.block = static_cast<int>(plant_.blocks.size()) - 1;
  }
  void turn(double inclination, double twist) {
    OrganAttributes attributes;
    attributes.inclination = inclination;
    attributes.twist = twist;
    organ(OrganKind::rotation, std::move(attributes));
  }
  // Moves on by `offset_m` without turning in the end: out to its direction, along a bare stem, back again.
  void move(const Eigen::Vector3d& offset_m) {
    const double direction = std::atan2(offset_m.y(), offset_m.x());
    const double inclination = std::atan2(std::hypot(offset_m.x(), offset_m.y()), offset_m.z());
    turn(0, direction);
    turn(inclination, 0);
    OrganAttributes stem;
    stem.length_m = offset_m.norm();
    organ(OrganKind::stem, std::move(stem));
    turn(-inclination, 0);
    turn(0, -direction);
  }

  int next_id() const {
    int out = 0;
    for (const auto& [kind, count] : count_) out += kind == OrganKind::rotation ? 0 : count;
    return out;
  }

 private:
  Plant& plant_;
  std::map<OrganKind, int> count_;
};

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
  const Eigen::Vector3d mean = sum / static_cast<double>(out.organs.size());
  out.origin_m = foot != nullptr ? foot->base_m : options.bud_m.value_or(mean);

  constexpr double no_offset_m = 1e-9;
  PlantWriter writer(out.plant);
  writer.open();
  for (const std::size_t k : out.organs) {
    const Eigen::Vector3d offset = fits[k].base_m - out.origin_m;
    writer.open();
    if (options.measured_bases && offset.norm() > no_offset_m) writer.move(offset);
    writer.turn(0, fits[k].direction);
    out.ids.push_back(writer.next_id());
    writer.organ(kind_of(fits[k].measured.organ), attributes_of(fits[k], options));
    writer.close();
  }
  writer.close();
  return out;
}

}  // namespace bpms
