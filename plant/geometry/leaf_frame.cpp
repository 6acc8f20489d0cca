#include "plant/leaf_frame.h"

#include <algorithm>
#include <cmath>

#include "plant/geometry/frame_rate.h"

namespace bpms {
namespace {

// Sine and cosine of an angle of the frame; most organs have not all three.
struct Turn {
  double sine = 0, cosine = 1;
};
Turn sine_cosine(double angle) {
  return angle == 0 ? Turn{} : Turn{std::sin(angle), std::cos(angle)};
}

double at(const std::unique_ptr<OrganFunction>& function, double l) {
  return function ? function->value(l) : 0.0;
}
double rate_at(const std::unique_ptr<OrganFunction>& function, double l) {
  return function ? function->derivative(l) : 0.0;
}

Eigen::Vector3d tangent(const OrganAttributes& organ, double l) {
  const Turn i = sine_cosine(at(organ.f_inclination, l)), a = sine_cosine(at(organ.f_azimuth, l));
  return {a.cosine * i.sine, -a.sine, a.cosine * i.cosine};
}

Eigen::Matrix3d frame_of_turns(const Turn& i, const Turn& a, const Turn& t) {
  const Eigen::Vector3d x(i.cosine, 0, -i.sine), y(i.sine * a.sine, a.cosine, i.cosine * a.sine);
  Eigen::Matrix3d out;
  out << t.cosine * x + t.sine * y, t.cosine * y - t.sine * x,
      Eigen::Vector3d(i.sine * a.cosine, -a.sine, i.cosine * a.cosine);
  return out;
}

Eigen::Vector3d rate_of_turns(const OrganAttributes& organ, double l, const Turn& a, const Turn& t) {
  const double di = rate_at(organ.f_inclination, l), da = rate_at(organ.f_azimuth, l);
  const double y = a.cosine * di;
  return {t.cosine * da + t.sine * y, t.cosine * y - t.sine * da, rate_at(organ.f_twist, l) - a.sine * di};
}

// Kronrod's extension of the three-node Gauss rule (Kronrod 1965); the middle node, then pairs.
struct KronrodNode {
  double x, weight, gauss_weight;
};
constexpr KronrodNode kronrod_7[] = {{0, 0.450916538658474142, 8.0 / 9},
                                     {0.434243749346802558, 0.401397414775962223, 0},
                                     {0.774596669241483377, 0.268488089868333441, 5.0 / 9},
                                     {0.960491268708020283, 0.104656226026467265, 0}};

// Halves the interval until the two rules agree: the better one is then good to the square of that.
Eigen::Vector3d integrate(const OrganAttributes& organ, double from, double to, int depth) {
  constexpr double agreement = 1e-7;
  const double half = (to - from) / 2, middle = (from + to) / 2;
  Eigen::Vector3d fine = Eigen::Vector3d::Zero(), coarse = fine;
  for (const KronrodNode& node : kronrod_7) {
    Eigen::Vector3d value = tangent(organ, middle + half * node.x);
    if (node.x > 0) value += tangent(organ, middle - half * node.x);
    fine += node.weight * value;
    coarse += node.gauss_weight * value;
  }
  if (depth == 0 || half * (fine - coarse).cwiseAbs().maxCoeff() < agreement) return half * fine;
  return integrate(organ, from, middle, depth - 1) + integrate(organ, middle, to, depth - 1);
}

}  // namespace

Eigen::Matrix3d organ_rotation(double inclination, double azimuth, double twist) {
  return frame_of_turns(sine_cosine(inclination), sine_cosine(azimuth), sine_cosine(twist));
}

Eigen::Matrix3d organ_frame(const OrganAttributes& organ, double l) {
  return organ_rotation(at(organ.f_inclination, l), at(organ.f_azimuth, l), at(organ.f_twist, l));
}

MovingFrame moving_frame(const OrganAttributes& organ, double l) {
  const Turn a = sine_cosine(at(organ.f_azimuth, l)), t = sine_cosine(at(organ.f_twist, l));
  return {frame_of_turns(sine_cosine(at(organ.f_inclination, l)), a, t), rate_of_turns(organ, l, a, t)};
}

Eigen::Vector3d frame_rate(const OrganAttributes& organ, double l) {
  return rate_of_turns(organ, l, sine_cosine(at(organ.f_azimuth, l)), sine_cosine(at(organ.f_twist, l)));
}

Eigen::Vector3d midrib_step(const OrganAttributes& organ, double from, double to) {
  constexpr int deepest = 18;
  if (!organ.f_inclination && !organ.f_azimuth) return (to - from) * Eigen::Vector3d::UnitZ();
  return integrate(organ, from, to, deepest);
}

Eigen::Vector3d short_midrib_step(const OrganAttributes& organ, double from, double to,
                                  const Eigen::Vector3d& rate) {
  constexpr double small_turn = 0.15;  // its 7th power over 2 million is what Gauss's rule is off by
  if (!organ.f_inclination && !organ.f_azimuth) return (to - from) * Eigen::Vector3d::UnitZ();
  if (!((to - from) * rate.head<2>().norm() < small_turn)) return midrib_step(organ, from, to);
  const double half = (to - from) / 2, middle = (from + to) / 2, reach = half * kronrod_7[2].x;
  return half * (8.0 / 9 * tangent(organ, middle) +
                 5.0 / 9 * (tangent(organ, middle - reach) + tangent(organ, middle + reach)));
}

std::vector<double> organ_breaks(const OrganAttributes& organ) {
  std::vector<double> out;
  for (const auto* function :
       {&organ.f_inclination, &organ.f_azimuth, &organ.f_twist, &organ.f_curvature, &organ.f_width}) {
    if (!*function) continue;
    const std::vector<double> breaks = (*function)->breaks();
    out.insert(out.end(), breaks.begin(), breaks.end());
  }
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::vector<MidribPoint> midrib(const OrganAttributes& organ, const std::vector<double>& l) {
  const std::vector<double> breaks = organ_breaks(organ);
  auto next_break = breaks.begin();
  std::vector<MidribPoint> out;
  out.reserve(l.size());
  double from = 0;
  Eigen::Vector3d at_from = Eigen::Vector3d::Zero();  // of unit length
  const auto advance = [&](double to) {
    if (to == from) return;
    at_from += midrib_step(organ, from, to);
    from = to;
  };
  for (const double to : l) {
    for (; next_break != breaks.end() && *next_break < to; ++next_break) {
      if (*next_break > from) advance(*next_break);
    }
    advance(to);
    out.push_back({to, organ.length_m * at_from, organ_frame(organ, to)});
  }
  return out;
}

}  // namespace bpms
