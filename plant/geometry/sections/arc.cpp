// The arc of a circle that turns by twice the half-angle: chord w sin(c)/c, sagitta w (1 - cos c) / (2 c). At
// 180 degrees the leaf is rolled to a closed tube.
#include <cmath>

#include "plant/geometry/sections/section.h"

namespace bpms {
namespace {

constexpr double small_angle = 1e-4;  // below it the series are exact to double precision

// sin(x) / x and (1 - cos x) / x with their derivatives.
struct Chord {
  double sinc, sinc_rate, cosc, cosc_rate, sine, cosine;
};
Chord chord(double x) {
  const double s = std::sin(x), c = std::cos(x);
  if (std::abs(x) < small_angle) return {1 - x * x / 6, -x / 3, x / 2, 0.5 - x * x / 8, s, c};
  const double h = std::sin(x / 2), versine = 2 * h * h;
  return {s / x, (x * c - s) / (x * x), versine / x, (x * s - versine) / (x * x), s, c};
}

class Arc final : public LeafSection {
 public:
  const char* name() const override { return "arc"; }
  SectionPoint point(const SectionForm& form, int, double s) const override {
    const double v = s / 2;
    if (form.half_angle == 0) return {{0, v}, {-v * s / 2, 0}, {0, 1}};
    const Chord k = chord(form.half_angle * s);
    return {{-v * k.cosc, v * k.sinc}, {-v * s * k.cosc_rate, v * s * k.sinc_rate}, {-k.sine, k.cosine}};
  }
  int pieces(const SectionForm& form, double tolerance) const override {
    constexpr double most_pairs = 128;
    const double pairs = std::ceil(std::sqrt(std::abs(form.half_angle) / (6 * tolerance)) / 2);
    return 2 * static_cast<int>(std::clamp(pairs, 1.0, most_pairs));
  }
  Eigen::Vector2d corner(const SectionForm& form, int panel, double s, double step) const override {
    const double half_step = form.half_angle * step / 2;
    const double stretch = std::abs(half_step) < 1e-6 ? 1 : half_step / std::sin(half_step);
    // With half a step h of the angle the mean shifts by R h^2 / 3.
    return stretch * point(form, panel, s).at + Eigen::Vector2d(form.half_angle * step * step / 24, 0);
  }
};

}  // namespace

const LeafSection& arc_section() {
  static const Arc section;
  return section;
}

}  // namespace bpms
