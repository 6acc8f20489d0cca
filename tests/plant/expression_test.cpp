// Constants and arithmetic in the place of numbers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "plant/plant.h"
#include "tests/data.h"
#include "tests/plant/plant_text.h"

namespace bpms {
namespace {

using enum ErrorKind;

// The value of an expression, as a leaf's twist in degrees.
double value_of(const std::string& expression, const std::string& before = "") {
  const Plant plant = parse_plant("x.bpms", before + " l l { a_twist " + expression + " }");
  return degrees(plant.blocks[0].attributes.twist);
}
#define EXPECT_VALUE(expression, value) \
  EXPECT_NEAR(value_of(expression), value, 1e-12 * (1 + std::abs(value))) << (expression)

TEST(Expression, ArithmeticByPrecedence) {
  EXPECT_VALUE("(1 + 2 * 3)", 7.0);
  EXPECT_VALUE("((1+2)*3)", 9.0);
  EXPECT_VALUE("(2-3-4)", -5.0);  // from the left
  EXPECT_VALUE("(24/4/2)", 3.0);
  EXPECT_VALUE("(2^3^2)", 512.0);  // from the right
  EXPECT_VALUE("(-2^2)", -4.0);
  EXPECT_VALUE("(2^-2)", 0.25);
  EXPECT_VALUE("(2*-3)", -6.0);
  EXPECT_VALUE("(--2 - +1)", 1.0);
  EXPECT_VALUE("(1.5e1 + .5)", 15.5);
  EXPECT_VALUE("(2e-1*10)", 2.0);
  EXPECT_VALUE("( 7\n# of the week\n - 4 )", 3.0);
}

TEST(Expression, Functions) {
  EXPECT_VALUE("(sqrt(2))", std::sqrt(2.0));
  EXPECT_VALUE("(abs(-3) + floor(2.7))", 5.0);
  EXPECT_VALUE("(min(3, 2) + 10 * max(3, 2))", 32.0);
  EXPECT_VALUE("(sin_deg(30) + 10 * cos_deg(60))", 5.5);
  EXPECT_VALUE("(tan_deg (45))", 1.0);
  EXPECT_REFUSED("l l { a_twist (sqr(2)) }",
                 "x.bpms:1:16: syntax error: unknown function 'sqr'; did you mean 'sqrt'?");
  EXPECT_REFUSED("l l { a_twist (min(2)) }",
                 "x.bpms:1:21: syntax error: found ')' in an expression, expected ',': min");
  EXPECT_REFUSED("l l { a_twist (sqrt(2, 3)) }",
                 "x.bpms:1:22: syntax error: found ',' in an expression, expected ')'");
}

TEST(Expression, ConstantsStandWhereNumbersDo) {
  const Plant plant =
      parse_plant("x.bpms",
                  "units mm\nlet lean = 30\nlet len=(lean / 2)\n[s[+l]]\n"
                  "l { a_length (2 * len + 1) a_width (len) f_inclination n 0 (lean) 1 (lean + 40) }");
  const OrganAttributes& leaf = plant.blocks[0].attributes;
  EXPECT_DOUBLE_EQ(leaf.length_m, 0.031);
  EXPECT_DOUBLE_EQ(leaf.width_m, 0.015);
  EXPECT_EQ(leaf.f_inclination->numbers(), (std::vector<double>{0, 30, 1, 70}));
  // What is written are numbers.
  EXPECT_THAT(plant_text(plant), testing::HasSubstr("  a_length 31\n"));
  EXPECT_THAT(plant_text(plant), testing::HasSubstr("  f_inclination n 0 30 1 70\n"));
  EXPECT_EQ(plant_text(parse_plant("x.bpms", plant_text(plant))), plant_text(plant));
}

TEST(Expression, ErrorsAreLocated) {
  EXPECT_REFUSED("l l { a_twist (1 +\n 2 / (3 - 3)) }", "x.bpms:2:4: semantic error: division by zero");
  EXPECT_REFUSED("l l { a_twist (sqrt(-1)) }", "x.bpms:1:16: semantic error: the result is not a number");
  EXPECT_REFUSED("l l { a_twist ((-2)^0.5) }", "x.bpms:1:20: semantic error: the result is not a number");
  EXPECT_REFUSED("l l { a_twist (1e300 * 1e300) }", "x.bpms:1:22: semantic error: the result is too large");
  EXPECT_REFUSED("l l { a_twist (1e400) }", "x.bpms:1:16: syntax error: found '1e400'");
  EXPECT_REFUSED("l l { a_twist (1 + ) }",
                 "x.bpms:1:20: syntax error: found ')' in an expression, expected a number");
  EXPECT_REFUSED("l l { a_twist (1 2) }",
                 "x.bpms:1:18: syntax error: found '2' in an expression, expected an operator");
  EXPECT_REFUSED("l l { a_twist () }", "x.bpms:1:16: syntax error: found ')' in an expression");
  EXPECT_REFUSED("l l { a_twist (1 + 2 }",
                 "x.bpms:1:15: syntax error: expression opened here is never closed");
  EXPECT_REFUSED("l l { a_twist (1 + (2 }",
                 "x.bpms:1:20: syntax error: expression opened here is never closed");
  EXPECT_REFUSED("l l { a_twist " + std::string(100, '(') + "1" + std::string(100, ')') + " }",
                 "more than 60 parentheses");
  EXPECT_REFUSED("l l { a_length (1 - 3) }",
                 "x.bpms:1:16: semantic error: a_length is -2, expected a size above 0");
}

TEST(Expression, NamesAreKnownBeforeTheyAreUsed) {
  EXPECT_REFUSED("let lean = 3 l l { a_twist (laen) }",
                 "x.bpms:1:29: semantic error: unknown name 'laen'; did you mean 'lean'?");
  EXPECT_REFUSED("l l { a_twist (lean) }",
                 "x.bpms:1:16: semantic error: unknown name 'lean'; constants are defined");
  EXPECT_REFUSED("let a = (b)\nlet b = 1 s",
                 "x.bpms:1:10: semantic error: 'b' is used before its definition at line 2");
  EXPECT_REFUSED("let a = 1\nlet a = 2 s",
                 "x.bpms:2:5: semantic error: a second 'a'; the first is at x.bpms:1:5");
  EXPECT_REFUSED("let a_length = 1 s", "x.bpms:1:5: semantic error: 'a_length' is an attribute");
  EXPECT_REFUSED("let material = 1 s", "'material' is an attribute");
  EXPECT_REFUSED("let p_x = 1 s", "'p_x' is an attribute");
  EXPECT_REFUSED("let sqrt = 1 s", "'sqrt' is a word of the language");
  EXPECT_REFUSED("let let = 1 s", "'let' is a word of the language");
  EXPECT_REFUSED("let 2a = 1 s", "x.bpms:1:5: syntax error: found '2a', expected the name of a constant");
  EXPECT_REFUSED("let a 1 s", "x.bpms:1:7: syntax error: found '1', expected '='");
  EXPECT_REFUSED("let a = x s",
                 "x.bpms:1:9: syntax error: found 'x', expected the value of a (a finite number)");
  EXPECT_REFUSED("let a = 1 let b = a s", "found 'a', expected the value of b (names stand in parentheses)");
  EXPECT_REFUSED("let a =", "x.bpms:1:8: syntax error: the file ends where the value of a was expected");
  EXPECT_REFUSED("s let a = 1", "x.bpms:1:3: syntax error: 'let' stands before the word");
  EXPECT_REFUSED("s s { } let a = 1", "x.bpms:1:9: syntax error: found 'let', expected a block");
  EXPECT_REFUSED("let a = 1 units mm s", "x.bpms:1:11: syntax error: 'units' stands first");
}

TEST(Word, GroupsAreRepeated) {
  const auto word = [](const std::string& text) {
    const std::string written = plant_text(parse_plant("x.bpms", text));
    const std::size_t begin = written.find('\n') + 1;
    return written.substr(begin, written.find('\n', begin) - begin);
  };
  EXPECT_EQ(word("<s[+l]>(3)h"), "s[+l]s[+l]s[+l]h");
  EXPECT_EQ(word("let n = 2 <s<[+l]>(n)>(n)"), "s[+l][+l]s[+l][+l]");
  EXPECT_EQ(word("<s>(0)b"), "b");
  EXPECT_EQ(word("[<sl>(0)s]"), "[s]");
  EXPECT_EQ(word("s<l>(1)"), "sl");
  EXPECT_EQ(word("<s(4)>(2)"), "s(4)s(4)");
  // Ordinals count what stands there in the end.
  const Plant plant =
      parse_plant("x.bpms", "<s>(3) s 3 { a_length 1 a_radius 0.1 } s { a_length 2 a_radius 0.1 }");
  EXPECT_EQ(plant.word[2].ordinal, 3);
  EXPECT_EQ(plant.word[2].block, 0);
  EXPECT_EQ(plant.word[1].block, 1);
}

TEST(Word, WrongGroupsAreLocated) {
  EXPECT_REFUSED("<s", "x.bpms:1:1: syntax error: group opened here is never closed");
  EXPECT_REFUSED("s>(2)", "x.bpms:1:2: syntax error: '>' closes a group that was never opened");
  EXPECT_REFUSED("<s>", "x.bpms:1:1: syntax error: a group without its count");
  EXPECT_REFUSED("<s>l", "a group without its count");
  EXPECT_REFUSED("<[s>(2)]",
                 "x.bpms:1:2: syntax error: bracket opened at column 2 is not closed within its group");
  EXPECT_REFUSED("[<s]>(2)", "x.bpms:1:4: syntax error: ']' closes a bracket from outside the group");
  EXPECT_REFUSED("<s>(1.5)",
                 "x.bpms:1:4: semantic error: a group is repeated 1.5 times, expected a whole number");
  EXPECT_REFUSED("<s>(-1)", "repeated -1 times");
  EXPECT_REFUSED("<<<s>(1000)>(1000)>(1000)", "a word of more than 100000 symbols");
  EXPECT_REFUSED("<sl>(2)", "x.bpms:1:1: semantic error: the repeated group ends with 'l'");
  EXPECT_REFUSED("<s>(0)", "x.bpms:1:1: semantic error: the word is empty");
}

}  // namespace
}  // namespace bpms
