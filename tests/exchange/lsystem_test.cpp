// L-systems: counts and lengths by closed forms, the turtle by hand, strings against their rules, mistakes.
#include "plant/lsystem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "tests/data.h"

namespace bpms {
namespace {

using enum ErrorKind;
using testing::HasSubstr;

const std::string honda_file = std::string(BPMS_SOURCE_DIR) + "/examples/lsystem/honda.lsys";

std::size_t count(const LString& string, char symbol) {
  return static_cast<std::size_t>(std::count_if(string.modules.begin(), string.modules.end(),
                                                [&](const LModule& m) { return m.symbol == symbol; }));
}
double total_length_m(const Mesh& mesh) {
  double out = 0;
  for (const Mesh::Organ& organ : mesh.organs) out += organ.length_m;
  return out;
}

// In figure 2.6 every apex makes a segment and two apices: 2^n - 1 segments after n steps. Of the trunk's
// apex come, per unit of its length, a_n = 1 + r2 b_(n-1) + r1 a_(n-1), of a branch's b_n = 1 + (r1 + r2)
// b_(n-1).
TEST(LSystem, HondaTreeHasExactCountsAndLengths) {
  const LSystem honda = read_lsystem(honda_file);
  EXPECT_EQ(honda.steps, 10);
  constexpr double r1 = 0.9, r2 = 0.6, s = r1 + r2;
  for (int n = 0; n <= 12; ++n) {
    const LString string = derive(honda, n);
    EXPECT_EQ(count(string, 'F'), (std::size_t{1} << n) - 1);
    EXPECT_EQ(count(string, '['), count(string, 'F'));
    EXPECT_EQ(count(string, '/'), static_cast<std::size_t>(n));
    EXPECT_EQ(count(string, 'A'), 1u);
    EXPECT_EQ(count(string, 'B') + count(string, 'C'), (std::size_t{1} << n) - 1);
    if (n == 0) continue;
    // b_n = (s^n - 1) / (s - 1), and the sum over the trunk of r1^k (1 + r2 b_(n-1-k)) in closed form.
    const double trunk = (1 - std::pow(r1, n)) / (1 - r1);
    const double length = trunk + r2 / (s - 1) * ((std::pow(s, n) - std::pow(r1, n)) / (s - r1) - trunk);
    if (n > 10) continue;
    EXPECT_NEAR(total_length_m(turtle(string).mesh) / length, 1, 1e-12) << n;
  }
}

TEST(LSystem, HondaTreeHasItsShape) {
  const TurtlePlant tree = turtle(derive(read_lsystem(honda_file)));
  // The trunk: sum of 0.9^k over ten steps, straight up; its first branch leans 45 degrees.
  float top = 0;
  for (const Eigen::Vector3f& p : tree.mesh.positions_m) top = std::max(top, p.z());
  const double trunk = (1 - std::pow(0.9, 10)) / 0.1;
  EXPECT_GT(top, trunk - 1e-5);
  const auto zz = tree.mtg.feature("ZZ"), xx = tree.mtg.feature("XX"), yy = tree.mtg.feature("YY");
  std::size_t on_trunk = 0;
  for (std::size_t v = 0; v < tree.mtg.vertices.size(); ++v) {
    if (tree.mtg.label(v) == "S2") {
      // &(45) pitches from up towards -U = y by 45 degrees; B's segment is 0.6 m long, on top of 1 m.
      EXPECT_NEAR(*tree.mtg.number(v, zz), 100 * (1 + 0.6 * std::cos(pi / 4)), 1e-6);
      EXPECT_NEAR(*tree.mtg.number(v, yy), 100 * 0.6 * std::sin(pi / 4), 1e-6);
      EXPECT_NEAR(*tree.mtg.number(v, xx), 0, 1e-6);
    }
    if (tree.mtg.scale(v) == 3 &&
        tree.mtg.label(static_cast<std::size_t>(tree.mtg.vertices[v].complex)) == "A1")
      ++on_trunk;
  }
  EXPECT_EQ(on_trunk, 10u);
  // An axis for the trunk and for each bracket that holds a segment: those of the last step hold apices.
  std::size_t axes = 0;
  for (std::size_t v = 0; v < tree.mtg.vertices.size(); ++v) axes += tree.mtg.scale(v) == 2 ? 1 : 0;
  EXPECT_EQ(axes, 512u);
  EXPECT_TRUE(parse_mtg("tree.mtg", mtg_text(tree.mtg)).same_as(tree.mtg));
  // The trunk's wall is ten frusta between diameters 10 cm 0.707^k, the last one a cylinder.
  double area = 0, wall = 0;
  for (int k = 0; k < 10; ++k) {
    const double r = 0.05 * std::pow(0.707, k), next = k < 9 ? 0.707 * r : r, l = std::pow(0.9, k);
    wall += pi * (r + next) * std::hypot(l, r - next) + (k == 9 ? pi * r * r : 0) + (k == 0 ? pi * r * r : 0);
  }
  for (std::size_t v = 0; v < tree.mtg.vertices.size(); ++v) {
    const std::int32_t organ = tree.organ_of_vertex[v];
    if (organ < 0 || tree.mtg.label(static_cast<std::size_t>(tree.mtg.vertices[v].complex)) != "A1") continue;
    area += tree.mesh.organs[static_cast<std::size_t>(organ)].area_m2;
  }
  // Polygons as long as their circles: the slant is off by (1 - cos(pi/n)) of the taper, lids by less than 2
  // %.
  EXPECT_NEAR(area / wall, 1, 1e-3);
}

TEST(LSystem, TheDerivedStringGivesTheSameTree) {
  const LString derived = derive(read_lsystem(honda_file));
  const std::string text = lstring_text(derived);
  const LString read = parse_lstring("honda.lstr", text);
  EXPECT_EQ(lstring_text(read), text);
  EXPECT_EQ(read.parameters, derived.parameters);
  const Mesh from_rules = turtle(derived).mesh, from_string = turtle(read).mesh;
  EXPECT_EQ(from_rules.positions_m, from_string.positions_m);
  EXPECT_EQ(from_rules.triangles, from_string.triangles);
  EXPECT_EQ(from_rules.organ_of_triangle, from_string.organ_of_triangle);
}

TEST(LSystem, ExampleStringIsWhatItsRulesDerive) {
  const std::string file = std::string(BPMS_SOURCE_DIR) + "/examples/lsystem/honda.lstr";
  EXPECT_EQ(lstring_text(read_lstring(file)), lstring_text(derive(read_lsystem(honda_file), 6)));
}

TEST(LSystem, ConditionsChooseTheFirstRuleThatHolds) {
  // ABOP section 1.10.1, the example of a parametric derivation: B(2) A(4, 4) and its next three strings.
  const LSystem book = parse_lsystem("book.lsys",
                                     "steps 3\naxiom B(2) A(4,4)\n"
                                     "A(x,y) : y <= 3 -> A(x*2, x+y)\nA(x,y) : y > 3 -> B(x) A(x/y, 0)\n"
                                     "B(x) : x < 1 -> F\nB(x) : x >= 1 -> B(x-1)\n");
  const auto modules = [&](int steps) {
    const std::string text = lstring_text(derive(book, steps));
    return text.substr(text.rfind('\n', text.size() - 2) + 1);
  };
  EXPECT_EQ(modules(0), "B(2)A(4,4)\n");
  EXPECT_EQ(modules(1), "B(1)B(4)A(1,0)\n");
  EXPECT_EQ(modules(2), "B(0)B(3)A(2,1)\n");
  EXPECT_EQ(modules(3), "FB(2)A(4,3)\n");
}

Eigen::Vector3d end_of(const std::string& modules) {
  const TurtlePlant plant = turtle(parse_lstring("t.lstr", "unit cm\nangle 90\n" + modules));
  const std::size_t last = plant.mtg.vertices.size() - 1;
  Eigen::Vector3d out;
  const char* names[] = {"XX", "YY", "ZZ"};
  for (int k = 0; k < 3; ++k) out[k] = *plant.mtg.number(last, plant.mtg.feature(names[k]));
  return out;
}

TEST(Turtle, TurnsByItsWords) {
  // H = z, L = -x, U = -y: left is west, down is north.
  const auto near = [](const Eigen::Vector3d& a, double x, double y, double z) {
    return (a - Eigen::Vector3d(x, y, z)).norm() < 1e-6;
  };
  EXPECT_TRUE(near(end_of("F(2)"), 0, 0, 2));
  EXPECT_TRUE(near(end_of("+F"), -1, 0, 0));
  EXPECT_TRUE(near(end_of("-F"), 1, 0, 0));
  EXPECT_TRUE(near(end_of("&F"), 0, 1, 0));
  EXPECT_TRUE(near(end_of("^F"), 0, -1, 0));
  EXPECT_TRUE(near(end_of("|F"), 0, 0, -1));
  EXPECT_TRUE(near(end_of("/+F"), 0, -1, 0));  // rolled right: left is where up was
  EXPECT_TRUE(near(end_of("\\+F"), 0, 1, 0));  // rolled left: left goes down
  EXPECT_TRUE(near(end_of("f(3)+(30)F(2)"), -1, 0, 3 + std::sqrt(3)));
  EXPECT_TRUE(near(end_of("F[+F]F"), 0, 0, 2));
  EXPECT_TRUE(near(end_of("-(60)/(77)$+F"), 0, 1, 0));  // heading east of up, levelled: left is V x H, north
}

TEST(Turtle, PolygonsAreLeaves) {
  // A right triangle with legs of 3 and 4 cm.
  const TurtlePlant plant = turtle(parse_lstring("t.lstr", "F{.f(3)+(90).-(90)f(-3)+(90)f(4).}"));
  ASSERT_EQ(plant.mesh.organs.size(), 2u);
  EXPECT_EQ(plant.mesh.organs[1].kind, "leaf");
  EXPECT_NEAR(plant.mesh.organs[1].area_m2, 6e-4, 1e-10);
}

TEST(Turtle, DeepBracketsNeedNoStack) {
  std::string modules;
  for (int k = 0; k < 20'000; ++k) modules += "F[+(1)";
  for (int k = 0; k < 20'000; ++k) modules += "]";
  EXPECT_EQ(turtle(parse_lstring("t.lstr", modules)).mesh.organs.size(), 20'000u);
}

TEST(LSystem, MistakesAreLocated) {
  const std::string good =
      "unit m\nsteps 3\na = 45\naxiom A(1, 10)\nA(l, w) -> !(w) F(l) [ &(a) A(l*0.6, w) ]\n  A(l*0.9, w)\n";
  EXPECT_EQ(count(derive(parse_lsystem("t.lsys", good)), 'F'), 7u);
  for (const auto& [from, to, says] : std::vector<std::array<std::string, 3>>{
           {"w) ]", "w)", "t.lsys:5:22: '[' is never closed in the rule"},
           {"[ &", "[ ] ] &", "t.lsys:5:26: ']' closes nothing"},
           {"A(1, 10)", "A(1)", "t.lsys:4:7: 'A' with 1 parameters, but its rule in line 5 has 2"},
           {"A(l*0.9, w)", "A(l*0.9, w, 1)",
            "t.lsys:6:3: 'A' with 3 parameters, but its rule in line 5 has 2"},
           {"A(l*0.9, w)", "K(l)", "t.lsys:6:3: unknown symbol 'K'"},
           {"F(l)", "F(l, w)", "t.lsys:5:17: 'F' with 2 parameters, expected none or one"},
           {"&(a)", "&(b)", "t.lsys:5:26: 'b' is neither a parameter here nor a constant"},
           {"a = 45", "a = 1/0", "t.lsys:3:5: the constant a is not finite"},
           {"a = 45", "a = 45 x", "t.lsys:3:8: expected the end of the line"},
           {"a = 45", "angel 45", "t.lsys:3:2: expected '->' of the rule for 'a'"},
           {"l*0.6", "(l*0.6", "expected ')' of the formula's bracket in line 5, column 31"},
           {"l*0.6", "1/(l-l)", "t.lsys:5:1: a parameter of 'A' is not finite"},
           {"->", "=>", "t.lsys:5:9: expected '->'"},
           {"steps 3", "steps many", "t.lsys:2:7: expected the number of steps"},
           {"steps 3", "steps 60", "t.lsys:2:7: more than 5000000 modules in step"},
           {"unit m", "unit furlong", "t.lsys:1:6: "},
           {"axiom A(1, 10)\n", "", "no axiom"}}) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    BPMS_EXPECT_ERROR(derive(parse_lsystem("t.lsys", text)), bad_input, says);
  }
  for (const auto& [text, says] : std::vector<std::pair<std::string, std::string>>{
           {"F[+F", "t.lstr:1:2: '[' is never closed in the string"},
           {"F]", "t.lstr:1:2: ']' closes nothing"},
           {"angle 30\nF(1,2)", "t.lstr:2:1: 'F' with 2 parameters, expected none or one"},
           {"F(x)", "t.lstr:1:3: expected a number"},
           {"F(1", "t.lstr:1:4: expected ',' or ')'"},
           {"F?", "t.lstr:1:2: unknown symbol '?'"},
           {"{[}", "t.lstr:1:3: '}' closes the '[' of line 1, column 2"},
           {"angle 30\n", "no modules"}})
    BPMS_EXPECT_ERROR(parse_lstring("t.lstr", text), bad_input, says);
}

TEST(Turtle, RefusesWhatNoPlantReaches) {
  BPMS_EXPECT_ERROR(turtle(parse_lstring("t.lstr", "F(2e9)")), bad_input, "goes beyond 1e7 m");
  BPMS_EXPECT_ERROR(turtle(parse_lstring("t.lstr", "!(9e44)F(1)")), bad_input, "wider than 1e7 m");
}

}  // namespace
}  // namespace bpms
