// Random multiscale graphs through the writer and the reader.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "plant/mtg.h"

namespace bpms {
namespace {

// Grows a graph by the rules of the noun: components of a complex follow each other or are borne by each
// other; the first component of a complex that follows another one starts from inside that one.
Mtg random_mtg() {
  Mtg out;
  for (int scale = 1; scale <= 3; ++scale)
    out.class_number(std::string(1, static_cast<char>('O' + scale)), scale);
  const std::uint32_t length = out.feature_number("len", "REAL"), remark = out.feature_number("rem", "ALPHA");
  const int size = *rc::gen::inRange(1, 60);
  std::vector<std::int32_t> attached;
  for (int k = 0; k < size; ++k) {
    MtgVertex v;
    v.index = *rc::gen::inRange(-1, 5);
    const auto count = static_cast<std::int32_t>(out.vertices.size());
    const auto at = [&](std::int32_t i) -> const MtgVertex& {
      return out.vertices[static_cast<std::size_t>(i)];
    };
    const auto scale = [&](std::int32_t i) { return out.scale(static_cast<std::size_t>(i)); };
    std::int32_t from = count == 0 ? -1 : *rc::gen::inRange<std::int32_t>(0, count);
    const int what = from < 0 ? 0 : *rc::gen::inRange(0, 4);
    std::int32_t attach = -1;
    if (from < 0 || what == 0) {  // a new plant
      v.symbol = 0;
    } else if (what == 1 && scale(from) < 3) {  // a component
      v.symbol = static_cast<std::uint32_t>(scale(from));
      v.complex = from;
      bool first = true;
      for (const MtgVertex& other : out.vertices) first = first && other.complex != from;
      if (first && at(from).parent >= 0) {
        attach = attached[static_cast<std::size_t>(from)];
        std::int32_t parent = attach;
        while (parent >= 0 && scale(parent) > scale(from) + 1) parent = at(parent).complex;
        if (parent >= 0 && scale(parent) == scale(from) + 1) v.parent = parent, v.edge = at(from).edge;
      }
    } else {  // after or on something, perhaps at a coarser scale
      attach = from;
      std::int32_t parent = from;
      if (what == 3 && at(parent).complex >= 0) parent = at(parent).complex;
      v.symbol = at(parent).symbol;
      v.parent = parent;
      v.after = from;
      v.complex = at(parent).complex;
      v.edge = *rc::gen::element('<', '+');
    }
    out.vertices.push_back(v);
    attached.push_back(attach);
    if (*rc::gen::inRange(0, 2) == 1) out.set(out.vertices.size() - 1, length, fmt::format("{}", k * 0.5));
    if (*rc::gen::inRange(0, 3) == 1) out.set(out.vertices.size() - 1, remark, "a b");
  }
  return out;
}

RC_GTEST_PROP(MtgProperties, ReadingWhatWasWrittenGivesTheSameGraph, ()) {
  const Mtg mtg = random_mtg();
  std::string written;
  try {
    written = mtg_text(mtg);
  } catch (const Error& error) {
    // What was written after a coarse entity whose parts came later: the form has no word for that.
    RC_PRE(false);
  }
  const Mtg again = parse_mtg("random.mtg", written);
  RC_ASSERT(again.vertices.size() == mtg.vertices.size());
  RC_ASSERT(again.same_as(mtg));
  RC_ASSERT(mtg_text(again) == written);
}

}  // namespace
}  // namespace bpms
