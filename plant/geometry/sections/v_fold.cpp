// Two flat halves that meet at the midrib, each lifted from the flat by the half-angle c: chord w cos(c),
// depth (w / 2) sin(c). At 90 degrees the leaf is folded shut.
#include <cmath>

#include "plant/geometry/sections/section.h"

namespace bpms {
namespace {

class VFold final : public LeafSection {
 public:
  const char* name() const override { return "v_fold"; }
  std::vector<double> folds(const SectionForm&) const override { return {0}; }
  SectionPoint point(const SectionForm& form, int panel, double s) const override {
    const double side = panel == 0 ? -1 : 1, v = std::abs(s) / 2;
    const double sine = std::sin(form.half_angle), cosine = std::cos(form.half_angle);
    return {{-v * sine, side * v * cosine}, {-v * cosine, -side * v * sine}, {-side * sine, cosine}};
  }
};

}  // namespace

const LeafSection& v_fold_section() {
  static const VFold section;
  return section;
}

}  // namespace bpms
