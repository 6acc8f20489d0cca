// The turtle: walks the word, carrying a frame; organs after a stem or bud start at its tip, in its tip
// frame.
#include "plant/leaf_frame.h"

namespace bpms {
namespace {

const OrganAttributes& attributes_of(const Plant& plant, const Symbol& symbol) {
  static const OrganAttributes none;
  return symbol.block >= 0 ? plant.blocks[static_cast<std::size_t>(symbol.block)].attributes : none;
}

// The frame at the organ's tip in the organ's own frame. A bud's tip is one diameter up its z axis.
Eigen::Isometry3d tip(OrganKind kind, const OrganAttributes& attributes) {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  if (kind == OrganKind::bud) out.translation().z() = 2 * attributes.radius_m;
  if (kind == OrganKind::stem) {
    const MidribPoint end = midrib(attributes, {1.0}).back();
    out.linear() = end.frame;
    out.translation() = end.x_m;
  }
  return out;
}

}  // namespace

std::vector<PlacedOrgan> place_organs(const Plant& plant) {
  std::vector<PlacedOrgan> out;
  std::vector<Eigen::Isometry3d> saved;
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < plant.word.size(); ++i) {
    const Symbol& symbol = plant.word[i];
    if (symbol.type == Symbol::Type::open) {
      saved.push_back(frame);
      continue;
    }
    if (symbol.type == Symbol::Type::close) {
      frame = saved.back();
      saved.pop_back();
      continue;
    }
    const OrganAttributes& attributes = attributes_of(plant, symbol);
    frame.linear() =
        frame.linear() * organ_rotation(attributes.inclination, attributes.azimuth, attributes.twist);
    if (symbol.kind == OrganKind::rotation) continue;
    PlacedOrgan organ;
    organ.symbol = static_cast<int>(i);
    organ.id = static_cast<int>(out.size());
    organ.kind = symbol.kind;
    organ.label = fmt::format("{}{}", letter(symbol.kind), symbol.ordinal);
    organ.attributes = &attributes;
    organ.plant_from_organ = frame;
    out.push_back(organ);
    frame = frame * tip(symbol.kind, attributes);
  }
  return out;
}

}  // namespace bpms
