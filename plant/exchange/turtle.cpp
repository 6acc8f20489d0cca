// The turtle: a place, a heading H, left L and up U (H x L = U). It starts at the origin, heading up, with
// left to the west.
#include <Eigen/Geometry>
#include <cmath>

#include "core/units.h"
#include "plant/exchange/axis_mesh.h"
#include "plant/exchange/lsystem_parts.h"
#include "plant/exchange/mtg_builder.h"

namespace bpms {
namespace {

constexpr double turtle_reach_m = 1e7;

struct TurtleState {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Matrix3d frame;  // columns H, L, U
  double radius_m = 0;
  std::int32_t vertex = -1;  // the segment before, in the graph
  bool branch = false;       // the next segment begins an axis of its own
  int axis = -1;             // index into the chains; -1: the next segment begins one
};

struct TurtleChain {
  std::vector<AxisNode> nodes;
  std::vector<std::uint32_t> organs;
  bool from_another = false;
};

class StringTurtle {
 public:
  StringTurtle(const LString& string, double tolerance_m)
      : string_(string),
        tolerance_m_(tolerance_m),
        metres_(metres_per_unit(string.settings.unit, {})),
        width_metres_(metres_per_unit(string.settings.width_unit, {})) {
    state_.frame << 0, -1, 0, 0, 0, -1, 1, 0, 0;  // H = z, L = -x, U = -y
    set_width(string.settings.width);
    Mtg& mtg = out_.mtg;
    mtg.file = string.file;
    plant_ = mtg.class_number("P", 1);
    axis_ = mtg.class_number("A", 2);
    segment_ = mtg.class_number("S", 3);
    leaf_ = mtg.class_number("L", 3);
    mtg.relations = {{"A", {"A"}, '+'}, {"S", {"S"}, '<', "1"}, {"S", {"S", "L"}, '+'}};
    for (const char* name : {"XX", "YY", "ZZ", "Length", "TopDia", "BotDia"})
      features_.push_back(mtg.feature_number(name, "REAL"));
  }

  TurtlePlant draw() {
    add_vertex('/', plant_, 1, -1);
    for (const LModule& module : string_.modules) read(module);
    for (const TurtleChain& chain : chains_) {
      std::vector<AxisNode> nodes = chain.nodes;
      add_axis(nodes, chain.organs, {tolerance_m_, !chain.from_another, true}, out_.mesh);
    }
    for (std::size_t i = 0; i < polygons_.size(); ++i)
      add_polygon(polygons_[i].corners, polygons_[i].organ, out_.mesh);
    set_diameters();
    return std::move(out_);
  }

 private:
  double parameter(const LModule& module, double otherwise) const {
    return module.count > 0 ? string_.parameters[module.first] : otherwise;
  }

  void read(const LModule& module) {
    const LSettings& usual = string_.settings;
    const double angle = radians(module.count > 0 ? parameter(module, 0) : usual.angle_deg);
    switch (module.symbol) {
      case 'F':
      case 'G':
        forward(parameter(module, usual.length) * metres_);
        break;
      case 'f':
        state_.position += parameter(module, usual.length) * metres_ * state_.frame.col(0);
        state_.axis = -1;
        break;
      case '!':
        set_width(parameter(module, usual.width));
        break;
      case '+':
        turn(0, 1, angle);
        break;
      case '-':
        turn(0, 1, -angle);
        break;
      case '&':
        turn(0, 2, -angle);
        break;
      case '^':
        turn(0, 2, angle);
        break;
      case '\\':
        turn(1, 2, -angle);
        break;
      case '/':
        turn(1, 2, angle);
        break;
      case '|':
        turn(0, 1, pi);
        break;
      case '$':
        level();
        break;
      case '[':
        open();
        break;
      case ']':
        state_ = stack_.back();
        stack_.pop_back();
        break;
      case '{':
        corners_.emplace_back();
        break;
      case '.':
        if (!corners_.empty()) corners_.back().push_back(state_.position);
        break;
      case '}':
        close_polygon();
        break;
      default:
        break;  // apices and colours draw nothing
    }
  }

  void set_width(double width) {
    state_.radius_m = std::abs(width) / 2 * width_metres_;
    if (!(state_.radius_m < turtle_reach_m)) bad_input({string_.file}, "a segment is wider than 1e7 m");
  }

  // Turns axis `from` towards axis `to` of the frame.
  void turn(int from, int to, double angle) {
    const Eigen::Vector3d a = state_.frame.col(from), b = state_.frame.col(to);
    state_.frame.col(from) = std::cos(angle) * a + std::sin(angle) * b;
    state_.frame.col(to) = std::cos(angle) * b - std::sin(angle) * a;
  }

  // Rolls until left is level; nothing to do when heading straight up or down.
  void level() {
    const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(state_.frame.col(0));
    constexpr double upright = 1e-9;
    if (left.norm() < upright) return;
    state_.frame.col(1) = left.normalized();
    state_.frame.col(2) = state_.frame.col(0).cross(state_.frame.col(1));
  }

  void open() {
    stack_.push_back(state_);
    state_.branch = state_.vertex >= 0;
    state_.axis = -1;
  }

  std::int32_t add_vertex(char edge, std::uint32_t symbol, int index, std::int32_t cursor) {
    const std::int32_t out = builder_.add(edge, symbol, index, cursor, {string_.file}, "a module");
    out_.organ_of_vertex.push_back(-1);
    return out;
  }

  std::uint32_t add_organ(const char* letter, int number, const char* kind, std::int32_t vertex) {
    Mesh::Organ organ;
    organ.id = static_cast<int>(out_.mesh.organs.size());
    organ.label = fmt::format("{}{}", letter, number);
    organ.kind = kind;
    organ.material = kind;
    out_.mesh.organs.push_back(std::move(organ));
    out_.organ_of_vertex[static_cast<std::size_t>(vertex)] =
        static_cast<std::int32_t>(out_.mesh.organs.size() - 1);
    return static_cast<std::uint32_t>(out_.mesh.organs.size() - 1);
  }

  // A segment: goes on in its axis, or begins one of its own where it is the first in a bracket.
  void forward(double length_m) {
    const Eigen::Vector3d from = state_.position;
    state_.position += length_m * state_.frame.col(0);
    if (!(state_.position.cwiseAbs().maxCoeff() < turtle_reach_m))
      bad_input({string_.file}, "the turtle goes beyond 1e7 m");
    if (!corners_.empty() || length_m == 0) return;  // inside of a polygon only places count
    char edge = '<';
    std::int32_t cursor = state_.vertex;
    if (state_.vertex < 0 || state_.branch) {
      cursor =
          add_vertex(state_.vertex < 0 ? '/' : '+', axis_, ++axes_, state_.vertex < 0 ? 0 : state_.vertex);
      edge = '/';
    }
    state_.vertex = add_vertex(edge, segment_, ++segments_, cursor);
    const std::uint32_t organ = add_organ("s", segments_, "stem", state_.vertex);
    out_.mesh.organs[organ].length_m = std::abs(length_m);
    if (state_.axis < 0 || chains_[static_cast<std::size_t>(state_.axis)].nodes.back().position_m != from) {
      state_.axis = static_cast<int>(chains_.size());
      chains_.push_back({{{from, state_.radius_m}}, {}, state_.branch});
    }
    state_.branch = false;
    TurtleChain& chain = chains_[static_cast<std::size_t>(state_.axis)];
    chain.nodes.back().radius_m = state_.radius_m;  // a frustum ends with the radius of the next one
    chain.nodes.push_back({state_.position, state_.radius_m});
    chain.organs.push_back(organ);
    segment_of_vertex_.push_back(
        {state_.vertex, static_cast<std::size_t>(state_.axis), chain.organs.size() - 1});
  }

  void close_polygon() {
    std::vector<Eigen::Vector3d> corners = std::move(corners_.back());
    corners_.pop_back();
    if (corners.size() < 3) return;
    std::int32_t vertex = 0;
    if (state_.vertex < 0) {
      const std::int32_t axis = add_vertex('/', axis_, ++axes_, 0);
      vertex = add_vertex('/', leaf_, ++leaves_, axis);
    } else {
      vertex = add_vertex('+', leaf_, ++leaves_, state_.vertex);
    }
    const std::uint32_t organ = add_organ("l", leaves_, "leaf", vertex);
    polygons_.push_back({std::move(corners), organ});
  }

  // Far ends and diameters in centimetres, as our other graphs have them.
  void set_diameters() {
    constexpr double per_metre = 100;
    for (const Segment& s : segment_of_vertex_) {
      const AxisNode& low = chains_[s.chain].nodes[s.place];
      const AxisNode& high = chains_[s.chain].nodes[s.place + 1];
      const double values[] = {high.position_m.x(), high.position_m.y(),
                               high.position_m.z(), (high.position_m - low.position_m).norm(),
                               2 * high.radius_m,   2 * low.radius_m};
      for (std::size_t k = 0; k < features_.size(); ++k)
        out_.mtg.set(static_cast<std::size_t>(s.vertex), features_[k],
                     fmt::format("{:.9g}", per_metre * values[k]));
    }
  }

  struct Polygon {
    std::vector<Eigen::Vector3d> corners;
    std::uint32_t organ = 0;
  };
  struct Segment {
    std::int32_t vertex = 0;
    std::size_t chain = 0, place = 0;
  };

  const LString& string_;
  double tolerance_m_, metres_, width_metres_;
  TurtlePlant out_;
  MtgBuilder builder_{out_.mtg};
  std::uint32_t plant_ = 0, axis_ = 0, segment_ = 0, leaf_ = 0;
  std::vector<std::uint32_t> features_;
  int axes_ = 0, segments_ = 0, leaves_ = 0;
  TurtleState state_;
  std::vector<TurtleState> stack_;
  std::vector<TurtleChain> chains_;
  std::vector<std::vector<Eigen::Vector3d>> corners_;
  std::vector<Polygon> polygons_;
  std::vector<Segment> segment_of_vertex_;
};

}  // namespace

TurtlePlant turtle(const LString& string, double tolerance_m) {
  return StringTurtle(string, tolerance_m).draw();
}

}  // namespace bpms
