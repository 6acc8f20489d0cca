// A flat blade with a keel along its midrib on the lower side, two slopes from the blade to the ridge:
// midrib_width is the keel's width at its foot, midrib_height how far the ridge stands off the blade, both
// over the leaf's width. The ridge is on the midrib, the blade lies that much towards the upper side. The
// slopes are part of the leaf's width: the blade measures w (1 - 2 hypot(midrib_width / 2, midrib_height))
// without the keel.
#include <cmath>

#include "plant/geometry/sections/section.h"

namespace bpms {
namespace {

double slope_length(const SectionForm& form) {
  return std::hypot(form.midrib_width / 2, form.midrib_height);
}

class RaisedMidrib final : public LeafSection {
 public:
  const char* name() const override { return "raised_midrib"; }
  bool has_curvature() const override { return false; }
  bool has_raised_midrib() const override { return true; }
  std::string complaint(const SectionForm& form) const override {
    constexpr double widest = 0.5;
    if (slope_length(form) < widest) return {};
    return fmt::format("the midrib's two slopes are {:.4g} of the width, expected less than 1",
                       2 * slope_length(form));
  }
  std::vector<double> folds(const SectionForm& form) const override {
    const double foot = 2 * slope_length(form);
    return {-foot, 0, foot};
  }
  SectionPoint point(const SectionForm& form, int panel, double s) const override {
    const double side = panel < 2 ? -1 : 1, slope = slope_length(form), v = std::abs(s) / 2;
    if (panel == 0 || panel == 3)
      return {{-form.midrib_height, side * (form.midrib_width / 2 + v - slope)}, {0, 0}, {0, 1}};
    const double up = form.midrib_height / slope, out = form.midrib_width / 2 / slope;
    return {{-v * up, side * v * out}, {0, 0}, {-side * up, out}};
  }
};

}  // namespace

const LeafSection& raised_midrib_section() {
  static const RaisedMidrib section;
  return section;
}

}  // namespace bpms
