#include "plant/geometry/bezier.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/error.h"

namespace bpms {
namespace {

using Curve = std::array<Eigen::Vector3d, 4>;

constexpr int most_segments = 1024;  // along one side of a patch

std::array<double, 4> bernstein(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}
std::array<double, 4> bernstein_slope(double t) {
  const double s = 1 - t;
  return {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t};
}

Eigen::Vector3d curve_point(const Curve& c, double t) {
  const auto b = bernstein(t);
  return b[0] * c[0] + b[1] * c[1] + b[2] * c[2] + b[3] * c[3];
}

// The largest second derivative of a cubic is at one of its ends: 6 |P_0 - 2 P_1 + P_2| or the like.
double bend(const Curve& c) {
  return 6 * std::max((c[0] - 2 * c[1] + c[2]).norm(), (c[1] - 2 * c[2] + c[3]).norm());
}

// A chord over a step h of a curve is off it by at most h^2 / 8 of its second derivative. Over a rectangle
// cut in two, the triangles are off by at most (h_u^2 |S_uu| + 2 h_u h_v |S_uv| + h_v^2 |S_vv|) / 8: a third
// each.
int segments(double second_derivative, double tolerance) {
  return static_cast<int>(
      std::ceil(std::clamp(std::sqrt(3 * second_derivative / (8 * tolerance)), 1.0, 1e9)));
}

bool before(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
}
// Does the curve come before itself run backwards? Only one of the two is ever evaluated.
bool runs_forward(const Curve& c) {
  for (std::size_t k = 0; k < 2; ++k)
    if (c[k] != c[3 - k]) return before(c[k], c[3 - k]);
  return true;
}

// One patch on its way into the mesh.
class Dicer {
 public:
  Dicer(const BezierPatch& patch, double tolerance, Mesh& mesh) : patch_(patch), mesh_(mesh) {
    organ_ = static_cast<std::uint32_t>(mesh.organs.size());
    double bend_u = 0, bend_v = 0, twist = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      bend_u = std::max(bend_u, bend(along_u(k)));
      bend_v = std::max(bend_v, bend(along_v(k)));
    }
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        twist = std::max(twist, 9 * (p(i, j) - p(i + 1, j) - p(i, j + 1) + p(i + 1, j + 1)).norm());
    int nu = segments(bend_u, tolerance), nv = segments(bend_v, tolerance);
    // 2 h_u h_v |S_uv| / 8 <= a third.
    const double product = 6 * twist / (8 * tolerance);
    if (const double more = product / (static_cast<double>(nu) * nv); more > 1) {
      nu = static_cast<int>(std::ceil(nu * std::sqrt(more)));
      nv = static_cast<int>(std::ceil(nv * std::sqrt(more)));
    }
    for (std::size_t e = 0; e < 4; ++e) edge_segments_[e] = segments(bend(edge(e)), tolerance);
    finest_ = std::max({nu, nv, edge_segments_[0], edge_segments_[1], edge_segments_[2], edge_segments_[3]});
    // An edge is cut as its own curve asks for, whatever the patch does beside it (so that neighbours agree):
    // where that is coarse, the strip beside it is narrow.
    const auto strip = [&](std::size_t e, double bend_along) {
      const double n = edge_segments_[e];
      return std::min(4 * tolerance * n / (3 * std::max(twist, 1e-300)),
                      8 * tolerance * n * n / (18 * std::max(bend_along, 1e-300)));
    };
    us_ = lines(nu, strip(3, bend_v), strip(1, bend_v));
    vs_ = lines(nv, strip(0, bend_u), strip(2, bend_u));
  }
  int finest() const { return finest_; }

  // A grid inside, and a strip along each edge to that edge's own points.
  void dice() {
    mesh_.organs.emplace_back();
    const std::size_t columns = us_.size(), rows = vs_.size();
    for (const double u : us_)
      for (const double v : vs_) inner_.push_back(add(u, v));
    for (std::size_t i = 0; i + 1 < columns; ++i) {
      for (std::size_t j = 0; j + 1 < rows; ++j) {
        triangle(inner(i, j), inner(i + 1, j), inner(i + 1, j + 1));
        triangle(inner(i, j), inner(i + 1, j + 1), inner(i, j + 1));
      }
    }
    // Counter-clockwise in (u, v), from corner to corner; the corners' vertices are shared.
    const std::uint32_t corners[4] = {add(0, 0), add(1, 0), add(1, 1), add(0, 1)};
    for (std::size_t e = 0; e < 4; ++e) {
      const std::vector<std::uint32_t> border = edge_vertices(e, corners[e], corners[(e + 1) % 4]);
      const std::vector<double>& along = e % 2 == 0 ? us_ : vs_;
      std::vector<std::uint32_t> inside;
      std::vector<double> at;
      for (std::size_t k = 0; k < along.size(); ++k) {
        const std::size_t back = along.size() - 1 - k;
        inside.push_back(e == 0   ? inner(k, 0)
                         : e == 1 ? inner(columns - 1, k)
                         : e == 2 ? inner(back, rows - 1)
                                  : inner(0, back));
        at.push_back(e < 2 ? along[k] : 1 - along[back]);
      }
      stitch(border, inside, at);
    }
    Mesh::Organ& organ = mesh_.organs[organ_];
    organ.id = static_cast<int>(organ_);
    organ.label = fmt::format("patch{}", organ_ + 1);
  }

 private:
  const Eigen::Vector3d& p(std::size_t i, std::size_t j) const { return patch_[4 * i + j]; }
  Curve along_u(std::size_t j) const { return {p(0, j), p(1, j), p(2, j), p(3, j)}; }
  Curve along_v(std::size_t i) const { return {p(i, 0), p(i, 1), p(i, 2), p(i, 3)}; }
  // Counter-clockwise in (u, v): v = 0, u = 1, v = 1 backwards, u = 0 backwards.
  Curve edge(std::size_t e) const {
    Curve c = e == 0 ? along_u(0) : e == 1 ? along_v(3) : e == 2 ? along_u(3) : along_v(0);
    if (e >= 2) std::reverse(c.begin(), c.end());
    return c;
  }
  static std::pair<double, double> edge_uv(std::size_t e, double t) {
    return e == 0   ? std::pair(t, 0.0)
           : e == 1 ? std::pair(1.0, t)
           : e == 2 ? std::pair(1 - t, 1.0)
                    : std::pair(0.0, 1 - t);
  }
  static double share(int i, int n) { return static_cast<double>(i) / n; }
  // The grid's inner lines: n even steps, and one closer to either side where the first would be too far.
  static std::vector<double> lines(int n, double first, double last) {
    constexpr double narrowest = 1e-4;
    n = std::max(n, 2);
    std::vector<double> out;
    if (first < share(1, n)) out.push_back(std::max(first, narrowest));
    for (int k = 1; k < n; ++k) out.push_back(share(k, n));
    if (last < share(1, n)) out.push_back(1 - std::max(last, narrowest));
    return out;
  }
  std::uint32_t inner(std::size_t i, std::size_t j) const { return inner_[i * vs_.size() + j]; }

  std::uint32_t add(double u, double v) { return add(u, v, patch_point(patch_, u, v).position); }
  std::uint32_t add(double u, double v, const Eigen::Vector3d& position) {
    mesh_.positions_m.push_back(position.cast<float>());
    mesh_.normals.push_back(patch_point(patch_, u, v).normal.cast<float>());
    mesh_.uv.emplace_back(static_cast<float>(u), static_cast<float>(v));
    return static_cast<std::uint32_t>(mesh_.positions_m.size() - 1);
  }

  std::vector<std::uint32_t> edge_vertices(std::size_t e, std::uint32_t from, std::uint32_t to) {
    const Curve c = edge(e);
    const bool forward = runs_forward(c);
    Curve run = c;
    if (!forward) std::reverse(run.begin(), run.end());
    const int n = edge_segments_[e];
    std::vector<std::uint32_t> out{from};
    for (int k = 1; k < n; ++k) {
      const auto [u, v] = edge_uv(e, share(k, n));
      out.push_back(add(u, v, curve_point(run, share(forward ? k : n - k, n))));
    }
    out.push_back(to);
    return out;
  }

  // Triangles between a border, cut evenly, and the inner line beside it, whose points lie at `at`: the side
  // that lags steps on.
  void stitch(const std::vector<std::uint32_t>& border, const std::vector<std::uint32_t>& inside,
              const std::vector<double>& at) {
    std::size_t b = 0, i = 0;
    while (b + 1 < border.size() || i + 1 < inside.size()) {
      // By the middles of the two possible steps: triangles then lean little.
      const auto border_middle = (static_cast<double>(b) + 0.5) / static_cast<double>(border.size() - 1);
      const bool step_border =
          i + 1 == inside.size() || (b + 1 < border.size() && border_middle <= 0.5 * (at[i] + at[i + 1]));
      if (step_border) {
        triangle(border[b], border[b + 1], inside[i]);
        ++b;
      } else {
        triangle(border[b], inside[i + 1], inside[i]);
        ++i;
      }
    }
  }

  // What has no area (pinched edges) is left out.
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const Eigen::Vector3f &x = mesh_.positions_m[a], &y = mesh_.positions_m[b], &z = mesh_.positions_m[c];
    if (x == y || y == z || z == x) return;
    mesh_.triangles.push_back({a, b, c});
    mesh_.organ_of_triangle.push_back(organ_);
    mesh_.organs[organ_].area_m2 += triangle_area_m2(mesh_, mesh_.triangles.size() - 1);
  }

  const BezierPatch& patch_;
  Mesh& mesh_;
  std::uint32_t organ_ = 0;
  std::array<int, 4> edge_segments_{};
  int finest_ = 1;
  std::vector<double> us_, vs_;  // of the inner lines
  std::vector<std::uint32_t> inner_;
};

}  // namespace

PatchPoint patch_point(const BezierPatch& patch, double u, double v) {
  const auto evaluate = [&patch](double a, double b) {
    PatchPoint out;
    const auto bu = bernstein(a), bv = bernstein(b), su = bernstein_slope(a), sv = bernstein_slope(b);
    out.position.setZero(), out.du.setZero(), out.dv.setZero();
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        out.position += bu[i] * bv[j] * patch[4 * i + j];
        out.du += su[i] * bv[j] * patch[4 * i + j];
        out.dv += bu[i] * sv[j] * patch[4 * i + j];
      }
    }
    return out;
  };
  PatchPoint out = evaluate(u, v);
  Eigen::Vector3d n = out.du.cross(out.dv);
  constexpr double pinched = 1e-9;  // sine between the tangents, or the length of one against the other
  const double longest = std::max(out.du.norm(), out.dv.norm());
  if (!(n.norm() > pinched * longest * longest)) {
    constexpr double beside = 1e-4;
    const PatchPoint inner = evaluate(u + beside * (0.5 - u), v + beside * (0.5 - v));
    n = inner.du.cross(inner.dv);
  }
  out.normal = n.norm() > 0 ? Eigen::Vector3d(n.normalized()) : Eigen::Vector3d::UnitZ();
  return out;
}

Mesh dice_patches(const std::vector<BezierPatch>& patches, double tolerance_m) {
  Mesh out;
  for (std::size_t k = 0; k < patches.size(); ++k) {
    Dicer dicer(patches[k], tolerance_m, out);
    if (dicer.finest() > most_segments)
      fail(ErrorKind::bad_input, {},
           "patch {} would be cut into more than {} pieces a side: give a tolerance above {:.3g} m", k + 1,
           most_segments, tolerance_m);
    dicer.dice();
  }
  return out;
}

double usual_patch_tolerance_m(const std::vector<BezierPatch>& patches) {
  constexpr double share = 1.0 / 2000;
  Eigen::Vector3d low = patches.front().front(), high = low;
  for (const BezierPatch& patch : patches)
    for (const Eigen::Vector3d& p : patch) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return std::max(share * (high - low).norm(), 1e-9);
}

}  // namespace bpms
