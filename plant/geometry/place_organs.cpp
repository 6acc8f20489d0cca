// The turtle: walks the word, carrying a frame; organs after a stem or bud start at its tip, in its tip
// frame.
#include <algorithm>

#include "plant/leaf_frame.h"

namespace bpms {
namespace {

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

void add_missing(OrganProperties& properties, const OrganProperties& more) {
  for (const auto& property : more) {
    const auto is_named = [&](const auto& own) { return own.first == property.first; };
    if (std::ranges::none_of(properties, is_named)) properties.push_back(property);
  }
}

class Turtle {
 public:
  explicit Turtle(const Plant& plant) : plant_(plant) {}

  std::vector<PlacedOrgan> walk() {
    walk_word(plant_, Eigen::Isometry3d::Identity(), "", {}, std::nullopt);
    return std::move(out_);
  }

 private:
  // `symbol`: of the plant's word, for the parts of a compound organ.
  void walk_word(const OrganWord& organs, Eigen::Isometry3d frame, const std::string& prefix,
                 const OrganProperties& properties, std::optional<int> symbol) {
    static const OrganAttributes none;
    std::vector<Eigen::Isometry3d> saved;
    for (std::size_t i = 0; i < organs.word.size(); ++i) {
      const Symbol& at = organs.word[i];
      if (at.type == Symbol::Type::open) {
        saved.push_back(frame);
        continue;
      }
      if (at.type == Symbol::Type::close) {
        frame = saved.back();
        saved.pop_back();
        continue;
      }
      const Block* block = at.block >= 0 ? &organs.blocks[static_cast<std::size_t>(at.block)] : nullptr;
      const OrganAttributes& attributes = block != nullptr ? block->attributes : none;
      frame.linear() =
          frame.linear() * organ_rotation(attributes.inclination, attributes.azimuth, attributes.twist);
      if (at.kind == OrganKind::rotation) continue;
      PlacedOrgan organ;
      organ.symbol = symbol.value_or(static_cast<int>(i));
      organ.kind = at.kind;
      organ.label = fmt::format("{}{}{}", prefix, letter(at.kind), at.ordinal);
      organ.properties = attributes.properties;
      add_missing(organ.properties, properties);
      if (at.kind == OrganKind::compound) {
        if (block != nullptr && block->compound >= 0)
          walk_word(plant_.compounds[static_cast<std::size_t>(block->compound)], frame, organ.label + ".",
                    organ.properties, organ.symbol);
        continue;
      }
      organ.id = static_cast<int>(out_.size());
      organ.attributes = &attributes;
      organ.plant_from_organ = frame;
      out_.push_back(std::move(organ));
      frame = frame * tip(at.kind, attributes);
    }
  }

  const Plant& plant_;
  std::vector<PlacedOrgan> out_;
};

}  // namespace

std::vector<PlacedOrgan> place_organs(const Plant& plant) {
  return Turtle(plant).walk();
}

}  // namespace bpms
