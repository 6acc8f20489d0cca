#include "plant/exchange/mtg_builder.h"

namespace bpms {

std::int32_t MtgBuilder::at_scale(std::int32_t vertex, int scale) const {
  while (vertex >= 0 && scale_of(vertex) > scale)
    vertex = mtg_.vertices[static_cast<std::size_t>(vertex)].complex;
  return vertex;
}

std::int32_t MtgBuilder::add(char edge, std::uint32_t symbol, int index, std::int32_t cursor,
                             const SourceLocation& where, std::string_view said) {
  constexpr std::size_t most_entities = 5'000'000;
  if (mtg_.vertices.size() >= most_entities) bad_input(where, "more than {} entities", most_entities);
  const int scale = mtg_.classes[symbol].scale;
  MtgVertex out{symbol, index, '/', -1, -1, -1, where.line};
  std::int32_t attached = cursor;
  if (edge == '/') {
    out.complex = at_scale(cursor, scale - 1);
    if (out.complex < 0 && cursor >= 0 && scale > 1 && scale_of(cursor) > 0)
      bad_input(where, "{} cannot be part of {}: no entity of a coarser scale above it", in_quotes(said),
                mtg_.label(static_cast<std::size_t>(cursor)));
    attached = -1;
    if (out.complex >= 0 && !has_component_[static_cast<std::size_t>(out.complex)]) {
      has_component_[static_cast<std::size_t>(out.complex)] = true;
      inherit(out, attached, scale);
    }
  } else {
    out.parent = at_scale(cursor, scale);
    if (out.parent < 0 || scale_of(out.parent) != scale)
      bad_input(where, "{}: there is no entity of scale {} before it that it could {}", in_quotes(said),
                scale, edge == '<' ? "follow" : "be borne by");
    out.edge = edge;
    out.after = cursor;
    out.complex = mtg_.vertices[static_cast<std::size_t>(out.parent)].complex;
  }
  mtg_.vertices.push_back(std::move(out));
  attached_.push_back(attached);
  has_component_.push_back(false);
  return static_cast<std::int32_t>(mtg_.vertices.size() - 1);
}

void MtgBuilder::inherit(MtgVertex& out, std::int32_t& attached, int scale) {
  const auto complex = static_cast<std::size_t>(out.complex);
  if (mtg_.vertices[complex].parent < 0) return;
  attached = attached_[complex];
  const std::int32_t parent = at_scale(attached, scale);
  if (parent < 0 || scale_of(parent) != scale) return;
  out.parent = parent;
  out.edge = mtg_.vertices[complex].edge;
}

}  // namespace bpms
