// Adds entities to a multiscale tree graph one after the other, each said by a relation to one before it.
#pragma once
#include <vector>

#include "plant/mtg.h"

namespace bpms {

class MtgBuilder {
 public:
  explicit MtgBuilder(Mtg& mtg) : mtg_(mtg) {}
  // '/': part of `cursor` (-1: of nothing) or of what that is part of; '<', '+': follows or is borne by
  // `cursor` or what that is part of, at the scale of the class. The first component of an entity that
  // follows or is borne does so too. bad_input at `where` when the scales do not allow it.
  std::int32_t add(char edge, std::uint32_t symbol, int index, std::int32_t cursor,
                   const SourceLocation& where, std::string_view said);

 private:
  int scale_of(std::int32_t vertex) const { return mtg_.scale(static_cast<std::size_t>(vertex)); }
  std::int32_t at_scale(std::int32_t vertex, int scale) const;  // the vertex or what it is part of
  void inherit(MtgVertex& out, std::int32_t& attached, int scale);

  Mtg& mtg_;
  std::vector<std::int32_t> attached_;  // the entity, of any scale, that a vertex was said after
  std::vector<bool> has_component_;
};

}  // namespace bpms
