// A surface from what an MTG's columns say. Points: XX YY ZZ are an entity's far end; an entity that has
// components and a point of its own gives the place where the first of them begins. Angles: as the AMAP
// family uses its columns, confirmed against a tree that exists as MTG and as OPF: a frame (t along, n, b)
// rolls by XEuler about t from one entity to the next and bends by StiffnessAngle from n towards -n; what is
// borne rolls by XInsertionAngle (or, the k-th at its place, by k times Phyllotaxy), leans by YInsertionAngle
// from t towards n, and begins at the bearer's surface.
#include <Eigen/Geometry>
#include <cmath>

#include "core/units.h"
#include "plant/exchange/axis_mesh.h"
#include "plant/opf.h"

namespace bpms {
namespace {

constexpr double usual_slenderness = 0.01;  // radius over length where no diameter is known

class MtgShape {
 public:
  MtgShape(const Mtg& mtg, const MtgGeometryOptions& options) : mtg_(mtg), options_(options) {
    const std::size_t count = mtg.vertices.size();
    first_.assign(count, false);
    organs_.assign(count, -1);
    std::vector<bool> met(count, false);
    for (std::size_t v = 0; v < count; ++v) {
      const std::int32_t complex = mtg.vertices[v].complex;
      if (complex < 0 || met[static_cast<std::size_t>(complex)]) continue;
      met[static_cast<std::size_t>(complex)] = first_[v] = true;
    }
  }

  Mesh mesh(std::vector<std::string>& notes) {
    const auto xx = mtg_.feature("XX"), yy = mtg_.feature("YY"), zz = mtg_.feature("ZZ");
    if (xx && yy && zz) {
      from_points(*xx, *yy, *zz);
    } else if (mtg_.feature("Length")) {
      from_angles();
    } else {
      bad_input({mtg_.file}, "no geometry: expected columns XX YY ZZ, or Length (with angles)");
    }
    for (const Chain& chain : chains_)
      add_axis(chain.nodes, chain.organs, {options_.tolerance_m, !chain.borne, true}, out_);
    if (out_.triangles.empty())
      bad_input({mtg_.file}, "no geometry: no entity has values in the columns of places or lengths");
    if (no_diameter_ > 0)
      notes.push_back(
          fmt::format("{}: {} entities without a diameter have that of the one before, or a hundredth "
                      "of their length as radius",
                      mtg_.file, no_diameter_));
    if (no_angle_ > 0)
      notes.push_back(fmt::format("{}: {} borne entities without YInsertionAngle lean by 45 degrees",
                                  mtg_.file, no_angle_));
    if (alone_ > 0)
      notes.push_back(fmt::format("{}: {} entities have a place but nothing before them that has one",
                                  mtg_.file, alone_));
    return std::move(out_);
  }

  std::vector<std::int32_t> organ_of_vertex() const { return organs_; }

 private:
  struct Chain {
    std::vector<AxisNode> nodes;
    std::vector<std::uint32_t> organs;
    bool borne = false;
  };
  struct Tip {  // where something may go on
    Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
    Eigen::Matrix3d frame;  // columns t, n, b
    double radius_m = 0;
    int chain = -1;
    bool placed = false;
  };

  const MtgVertex& at(std::size_t v) const { return mtg_.vertices[v]; }
  std::optional<double> number(std::size_t v, const char* name) const {
    return mtg_.number(v, mtg_.feature(name));
  }

  std::uint32_t add_organ(std::size_t v, double length_m) {
    Mesh::Organ organ;
    organ.id = static_cast<int>(out_.organs.size());
    organ.label = mtg_.label(v);
    const std::string kind = kind_of_class(mtg_.classes[at(v).symbol].symbol);
    organ.kind = kind == "mesh" ? "stem" : kind;
    organ.material = organ.kind;
    organ.length_m = length_m;
    for (const MtgValue& value : at(v).values)
      organ.properties.emplace_back(mtg_.features[value.feature].name, value.text);
    out_.organs.push_back(std::move(organ));
    organs_[v] = static_cast<std::int32_t>(out_.organs.size() - 1);
    return static_cast<std::uint32_t>(out_.organs.size() - 1);
  }

  double radius(std::optional<double> diameter, double before_m, double length_m) {
    if (diameter && *diameter > 0) return *diameter / 2 * options_.metres_per_diameter_unit;
    ++no_diameter_;
    return before_m > 0 ? before_m : usual_slenderness * length_m;
  }

  // Goes on in the chain of `before`, or begins one at `from`.
  int extend(int before, bool follows, const Eigen::Vector3d& from_m, double from_radius_m,
             const Eigen::Vector3d& to_m, double to_radius_m, std::uint32_t organ) {
    const bool goes_on =
        follows && before >= 0 && chains_[static_cast<std::size_t>(before)].nodes.back().position_m == from_m;
    if (!goes_on) {
      chains_.push_back({{{from_m, from_radius_m}}, {}, before >= 0});
      before = static_cast<int>(chains_.size() - 1);
    }
    Chain& chain = chains_[static_cast<std::size_t>(before)];
    chain.nodes.push_back({to_m, to_radius_m});
    chain.organs.push_back(organ);
    return before;
  }

  void from_points(std::uint32_t xx, std::uint32_t yy, std::uint32_t zz) {
    std::vector<Tip> end(mtg_.vertices.size()), start(mtg_.vertices.size());
    std::vector<bool> parts(mtg_.vertices.size(), false);
    for (const MtgVertex& vertex : mtg_.vertices)
      if (vertex.complex >= 0) parts[static_cast<std::size_t>(vertex.complex)] = true;
    for (std::size_t v = 0; v < mtg_.vertices.size(); ++v) {
      const auto x = mtg_.number(v, xx), y = mtg_.number(v, yy), z = mtg_.number(v, zz);
      const bool placed = x && y && z;
      Eigen::Vector3d here = Eigen::Vector3d::Zero();
      if (placed) here = options_.metres_per_unit * Eigen::Vector3d(*x, *y, *z);
      check_place(v, here);
      start[v] = start_of(v, here, placed, end, start);
      end[v] = start[v];
      if (!placed) continue;
      if (!parts[v]) add_piece(v, start[v], here, end[v]);
      end[v].position_m = here;
      end[v].placed = true;
    }
  }

  void check_place(std::size_t v, const Eigen::Vector3d& place_m) const {
    constexpr double farthest_m = 1e7;
    if (!(place_m.cwiseAbs().maxCoeff() < farthest_m))
      bad_input({mtg_.file, at(v).line}, "{} lies beyond 1e7 m", mtg_.label(v));
  }

  Tip start_of(std::size_t v, const Eigen::Vector3d& here, bool placed, const std::vector<Tip>& end,
               const std::vector<Tip>& start) const {
    Tip out;
    const std::int32_t parent = at(v).parent, complex = at(v).complex;
    if (parent >= 0) out = end[static_cast<std::size_t>(parent)];
    if (!first_[v]) return out;
    const Tip& base = end[static_cast<std::size_t>(complex)];
    const bool own = base.placed && !(placed && base.position_m == here) &&
                     base.position_m != start[static_cast<std::size_t>(complex)].position_m;
    if (own || !out.placed) {
      const Tip bearer = out;
      out = own || !start[static_cast<std::size_t>(complex)].placed
                ? base
                : start[static_cast<std::size_t>(complex)];
      if (bearer.placed) out.radius_m = bearer.radius_m;
    }
    return out;
  }

  void add_piece(std::size_t v, const Tip& from, const Eigen::Vector3d& here, Tip& end) {
    if (!from.placed) {
      ++alone_;
      return;
    }
    const double length = (here - from.position_m).norm();
    if (length == 0) return;
    const double top = radius(number(v, "TopDia"), from.radius_m, length);
    const auto bottom = number(v, "BotDia");
    const bool follows = at(v).edge == '<';
    // A branch is no thicker at its base than at its tip unless it is said to be.
    const double low = bottom && *bottom > 0          ? *bottom / 2 * options_.metres_per_diameter_unit
                       : follows && from.radius_m > 0 ? from.radius_m
                                                      : top;
    end.chain = extend(from.chain, follows, from.position_m, low, here, top, add_organ(v, length));
    end.radius_m = top;
  }

  // The value at the entity, or at what it is the first component of.
  std::optional<double> value_of_first(std::size_t v, const char* name) const {
    for (;;) {
      if (const auto value = number(v, name)) return value;
      if (!first_[v]) return std::nullopt;
      v = static_cast<std::size_t>(at(v).complex);
    }
  }
  std::int32_t bearer_of(std::size_t v) const {
    while (at(v).after < 0 && first_[v]) v = static_cast<std::size_t>(at(v).complex);
    return at(v).after;
  }

  static void roll(Eigen::Matrix3d& frame, double angle) { turn(frame, 1, 2, angle); }
  static void lean(Eigen::Matrix3d& frame, double angle) { turn(frame, 0, 1, angle); }
  static void turn(Eigen::Matrix3d& frame, int from, int to, double angle) {
    const Eigen::Vector3d a = frame.col(from), b = frame.col(to);
    frame.col(from) = std::cos(angle) * a + std::sin(angle) * b;
    frame.col(to) = std::cos(angle) * b - std::sin(angle) * a;
  }

  void from_angles() {
    std::vector<bool> finest(mtg_.vertices.size());
    for (std::size_t v = 0; v < mtg_.vertices.size(); ++v) {
      finest[v] = number(v, "Length").has_value();
      if (finest[v] && at(v).complex >= 0) finest[static_cast<std::size_t>(at(v).complex)] = false;
    }
    Tip ground;
    ground.frame << 0, 1, 0, 0, 0, 1, 1, 0, 0;  // t up, n east, b north
    ground.placed = true;
    std::vector<Tip> tips(mtg_.vertices.size(), ground);
    std::vector<int> borne(mtg_.vertices.size(), 0);
    for (std::size_t v = 0; v < mtg_.vertices.size(); ++v) {
      const std::int32_t bearer = bearer_of(v), parent = at(v).parent;
      const bool follows = at(v).edge == '<' && parent >= 0;
      if (follows)
        tips[v] = tips[static_cast<std::size_t>(parent)];
      else if (bearer >= 0)
        tips[v] = tips[static_cast<std::size_t>(bearer)];
      else if (at(v).complex >= 0)
        tips[v] = tips[static_cast<std::size_t>(at(v).complex)];
      if (!finest[v]) continue;
      if (!follows && bearer >= 0) insert(v, borne[static_cast<std::size_t>(bearer)]++, tips[v]);
      lay(v, follows, tips[v]);
    }
  }

  void insert(std::size_t v, int nth, Tip& tip) {
    const auto turned = value_of_first(v, "XInsertionAngle");
    const double usual = nth * value_of_first(v, "Phyllotaxy").value_or(0);
    roll(tip.frame, radians(turned.value_or(usual)));
    const auto leans = value_of_first(v, "YInsertionAngle");
    constexpr double usual_lean_deg = 45;
    if (!leans) ++no_angle_;
    const Eigen::Vector3d outward = tip.frame.col(1);
    lean(tip.frame, radians(leans.value_or(usual_lean_deg)));
    tip.position_m += tip.radius_m * outward;
  }

  void lay(std::size_t v, bool follows, Tip& tip) {
    roll(tip.frame, radians(number(v, "XEuler").value_or(0)));
    lean(tip.frame, -radians(number(v, "StiffnessAngle").value_or(0)));
    const double length = *number(v, "Length") * options_.metres_per_unit;
    const Eigen::Vector3d from = tip.position_m;
    const Eigen::Vector3d along = length * tip.frame.col(0);
    check_place(v, from + along);
    const std::string kind = kind_of_class(mtg_.classes[at(v).symbol].symbol);
    if (!(length > 0)) return;
    if (kind == "leaf") {
      const double width = number(v, "Width").value_or(0) * options_.metres_per_unit;
      if (width > 0) add_blade(from, along, width / 2 * tip.frame.col(2), add_organ(v, length), out_);
      return;
    }
    auto width = number(v, "Width");
    if (!width) width = number(v, "TopDia");
    const double thick = radius(width, tip.radius_m, length);
    if (follows && tip.chain >= 0 &&
        chains_[static_cast<std::size_t>(tip.chain)].nodes.back().position_m == from)
      chains_[static_cast<std::size_t>(tip.chain)].nodes.back().radius_m = thick;
    tip.chain = extend(tip.chain, follows, from, thick, from + along, thick, add_organ(v, length));
    tip.position_m = from + along;
    tip.radius_m = thick;
  }

  const Mtg& mtg_;
  const MtgGeometryOptions& options_;
  std::vector<bool> first_;  // component of its complex
  std::vector<std::int32_t> organs_;
  std::vector<Chain> chains_;
  Mesh out_;
  std::size_t no_diameter_ = 0, no_angle_ = 0, alone_ = 0;
};

}  // namespace

Mesh mtg_mesh(const Mtg& mtg, const MtgGeometryOptions& options, std::vector<std::string>& notes,
              std::vector<std::int32_t>* organ_of_vertex) {
  MtgShape shape(mtg, options);
  Mesh out = shape.mesh(notes);
  if (organ_of_vertex != nullptr) *organ_of_vertex = shape.organ_of_vertex();
  return out;
}

}  // namespace bpms
