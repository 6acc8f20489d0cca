// Every rule of the plant language: what is read, what is refused and where, what is noted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/units.h"
#include "plant/plant.h"
#include "tests/data.h"
#include "tests/plant/plant_text.h"

namespace bpms {
namespace {

using enum ErrorKind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string word_of(const Plant& plant) {
  const std::string text = plant_text(plant);
  const std::size_t begin = text.find('\n') + 1;
  return text.substr(begin, text.find('\n', begin) - begin);
}
std::vector<int> blocks_of(const Plant& plant, OrganKind kind) {
  std::vector<int> out;
  for (const Symbol& symbol : plant.word) {
    if (symbol.type == Symbol::Type::organ && symbol.kind == kind) out.push_back(symbol.block);
  }
  return out;
}
const std::string leaf = " a_length 10 a_width 1 ";

TEST(PlantLanguage, ReadsThePapersLeaf) {
  const Plant plant = test::plant_of(
      "l\nl 1 {\nmaterial      leaf\na_length     10.0\na_width      3.0\nf_inclination n 0 0 1 180\n"
      "f_azimuth    n 0 0 1 0\nf_twist      n 0 0 1 0\nf_curvature  n 0 30 1 30\n}\n");
  ASSERT_EQ(plant.blocks.size(), 1u);
  const OrganAttributes& a = plant.blocks[0].attributes;
  EXPECT_EQ(plant.unit, "cm");  // absent: as in the paper
  EXPECT_EQ(a.material, "leaf");
  EXPECT_DOUBLE_EQ(a.length_m, 0.1);
  EXPECT_DOUBLE_EQ(a.width_m, 0.03);
  EXPECT_DOUBLE_EQ(a.f_inclination->value(1), pi);
  EXPECT_DOUBLE_EQ(a.f_curvature->value(0.4), radians(30));
  EXPECT_FALSE(a.f_width);
  EXPECT_THAT(plant.warnings, IsEmpty());
}

TEST(PlantLanguage, ReadsUnitsCommentsAndTightLayouts) {
  EXPECT_DOUBLE_EQ(test::plant_of("units mm s s{a_length 5 a_radius 1}").blocks[0].attributes.length_m,
                   0.005);
  EXPECT_DOUBLE_EQ(test::plant_of("units m # metres\n s # word\n s { # block\n a_length 5 a_radius 1 }")
                       .blocks[0]
                       .attributes.length_m,
                   5);
  const Plant plant = test::plant_of("[s [+l(3)] [ + l( 4 ) ]\n s h]\nl 5{" + leaf + "}", false);
  EXPECT_EQ(word_of(plant), "[s[+l(3)][+l(4)]sh]");
}

TEST(PlantLanguage, AttributesOnOneLineInAnyOrder) {
  const Plant plant = test::plant_of(
      "l l { f_twist f 10 -10 f_width n 0 1 1 0 a_width 2 material m_1.x-y a_inclination -30 a_length 1e1 }");
  const OrganAttributes& a = plant.blocks[0].attributes;
  EXPECT_EQ(a.material, "m_1.x-y");
  EXPECT_DOUBLE_EQ(a.inclination, radians(-30));
  EXPECT_DOUBLE_EQ(a.f_width->value(0.25), 0.75);  // a fraction, not an angle
  EXPECT_DOUBLE_EQ(a.f_twist->value(1), radians(20));
}

TEST(PlantLanguage, UnbalancedBracketsAreLocatedWithAHint) {
  const std::string printed = "[bsb[+][+][+sb[+][+][+sb[+][+][+]]]";
  EXPECT_REFUSED(printed, "x.bpms:1:1: syntax error: bracket opened at column 1 is never closed");
  EXPECT_REFUSED(printed, "--lenient");
  EXPECT_REFUSED("s\n [s[+l] l { }", "x.bpms:2:2: syntax error: bracket opened at column 2");
  EXPECT_REFUSED("[s]] s { }", "x.bpms:1:4: syntax error: ']' closes a bracket that was never opened");
  const Plant repaired = test::plant_of(printed, true);
  EXPECT_EQ(word_of(repaired), printed + "]");
  EXPECT_THAT(repaired.warnings,
              testing::Contains(
                  HasSubstr("x.bpms:1:1: bracket opened at column 1 is never closed; closed at the end")));
  BPMS_EXPECT_ERROR(test::plant_of("s]", true), bad_input, "never opened");  // lenient invents no brackets
}

TEST(PlantLanguage, NothingGrowsFromLeavesAndHeads) {
  EXPECT_REFUSED("[sls]", "x.bpms:1:4: semantic error: 's' after 'l' in the same bracket");
  EXPECT_REFUSED("hl",
                 "x.bpms:1:2: semantic error: 'l' after 'h' in the same bracket: nothing grows from a head");
  EXPECT_REFUSED("l+", "semantic error: '+' after 'l'");
  EXPECT_REFUSED("s[l[s]]", "x.bpms:1:5: semantic error: 's' after 'l'");
  EXPECT_THAT(word_of(test::plant_of("[[l]s[+l][h]]")), "[[l]s[+l][h]]");
  EXPECT_THAT(word_of(test::plant_of("[sl[]]")), "[sl[]]");
}

TEST(PlantLanguage, SyntaxErrorsInTheWord) {
  EXPECT_REFUSED("[sxl]",
                 "x.bpms:1:3: syntax error: unknown letter 'x' in the word; known: b s l h c + [ ] < >");
  EXPECT_REFUSED("s l1",
                 "x.bpms:1:4: syntax error: a number in the word; a label is written in parentheses: l(1)");
  EXPECT_REFUSED("l(1", "x.bpms:1:2: syntax error: label opened here is never closed");
  EXPECT_REFUSED("l(1 2)", "label '(1 2)', expected a whole number");
  EXPECT_REFUSED("l(-1)", "expected a whole number");
  EXPECT_REFUSED("l()", "expected a whole number");
  EXPECT_REFUSED("l(99999999999999999999)", "expected a whole number");
  EXPECT_REFUSED("l { }", "x.bpms:1:1: syntax error: no word before the blocks");
  EXPECT_REFUSED("units cm\n", "x.bpms:2:1: syntax error: no word before the blocks");
  EXPECT_REFUSED("units inch\ns", "x.bpms:1:7: syntax error: unknown unit 'inch'");
  EXPECT_REFUSED("s } ", "x.bpms:1:3: syntax error: '}' without a block");
  EXPECT_REFUSED("s leaf { }", "x.bpms:1:8: syntax error: '{' without an organ letter before it");
}

TEST(PlantLanguage, SyntaxErrorsInBlocks) {
  EXPECT_REFUSED("l\nl 1 {" + leaf, "x.bpms:2:5: syntax error: block opened here is never closed");
  EXPECT_REFUSED("l\nl 1 {" + leaf + "\nl 2 { }", "x.bpms:3:1: syntax error: unknown attribute 'l'");
  EXPECT_REFUSED("l l { { }", "x.bpms:1:7: syntax error: '{' inside a block");
  EXPECT_REFUSED("l l { } x { }", "x.bpms:1:9: syntax error: found 'x', expected a block");
  EXPECT_REFUSED("l l 1.5 { }", "x.bpms:1:5: syntax error: found '1.5', expected the block's number");
  EXPECT_REFUSED("l l { } l 2 3 { }", "x.bpms:1:13: syntax error: found '3', expected '{'");
  EXPECT_REFUSED("l l {\n a_lenght 3 }",
                 "x.bpms:2:2: syntax error: unknown attribute 'a_lenght'; did you mean 'a_length'?");
  EXPECT_REFUSED("l l { a_length ten }",
                 "x.bpms:1:16: syntax error: found 'ten', expected a_length (a finite number)");
  EXPECT_REFUSED("l l { a_length nan }", "x.bpms:1:16: syntax error: found 'nan'");
  EXPECT_REFUSED("l l { a_length 1e400 }", "x.bpms:1:16: syntax error: found '1e400'");
  EXPECT_REFUSED("l l { a_length 3,5 }", "found '3,5'");
  EXPECT_REFUSED("l l { a_length 3 5 }",
                 "x.bpms:1:18: syntax error: found '5', expected an attribute name or '}'");
  EXPECT_REFUSED("l l { material }", "x.bpms:1:16: syntax error: found '}', expected a material's name");
  EXPECT_REFUSED("l l { material a_length 3 }", "found 'a_length', expected a material's name");
  EXPECT_REFUSED("l l { f_twist }", "x.bpms:1:15: syntax error: f_twist without a function");
  EXPECT_REFUSED("l l { f_twist 10 20 }", "x.bpms:1:15: syntax error: found '10', expected a function code");
  EXPECT_REFUSED("l l { f_twist q 20 }", "x.bpms:1:15: syntax error: f_twist: unknown function code 'q'");
  EXPECT_REFUSED("l l { f_twist n 0 0 0.5 1 0.4 2 1 3 }",
                 "x.bpms:1:15: syntax error: f_twist: function n: l = 0.4 of pair 3 does not rise");
  EXPECT_REFUSED("l l { f_twist n 0 0 nan 1 }", "x.bpms:1:21: syntax error: found 'nan'");
  EXPECT_REFUSED("l l { f_twist p 1 2x }", "x.bpms:1:19: syntax error: found '2x'");
  EXPECT_REFUSED("l l { f_twist p 1e9 }", "x.bpms:1:15: syntax error: f_twist: function p: number 1");
}

TEST(PlantLanguage, SemanticErrorsInBlocks) {
  EXPECT_REFUSED("l l 1 { }\nl 1 { }",
                 "x.bpms:2:1: semantic error: a second block 'l 1'; the first is at line 1");
  EXPECT_REFUSED("l l { }\n l { }", "x.bpms:2:2: semantic error: a second block 'l'");
  EXPECT_REFUSED("l l { a_twist 3 f_twist p 1 }",
                 "x.bpms:1:17: semantic error: 'f_twist' beside 'a_twist' in one block");
  EXPECT_REFUSED("l l { f_azimuth p 1\n a_azimuth 3 }",
                 "x.bpms:2:2: semantic error: 'a_azimuth' beside 'f_azimuth'");
  EXPECT_REFUSED("l l { a_width 3 a_width 3 }",
                 "x.bpms:1:17: semantic error: a second 'a_width' in one block");
  EXPECT_REFUSED("l l { a_length 0 }", "x.bpms:1:16: semantic error: a_length is 0, expected a size above 0");
  EXPECT_REFUSED("l l { a_width -3 }", "x.bpms:1:15: semantic error: a_width is -3, expected a size above 0");
  EXPECT_REFUSED("s s { a_radius -0.1 }", "a_radius is -0.1, expected a size above 0");
  EXPECT_REFUSED("units m l l { a_length 10001 }",
                 "x.bpms:1:24: semantic error: a_length is 10001 m, expected at most 10000 m");
  EXPECT_REFUSED("l l { a_twist 2e6 }", "a_twist is 2000000 degrees");
  EXPECT_REFUSED("s s { a_width 2 }",
                 "x.bpms:1:7: semantic error: a stem has no a_width; it has material, a_length, a_radius");
  EXPECT_REFUSED("+ + { material leaf }", "semantic error: a rotation has no material");
  EXPECT_REFUSED("b b { f_twist p 1 }", "semantic error: a bud has no f_twist");
  // a_width is what f_width scales: the two belong together.
  EXPECT_NO_THROW(test::plant_of("l l { a_length 3 a_width 3 f_width p 1 }"));
}

TEST(PlantLanguage, BlocksBelongToLabelsElseToOrdinalsElseToAll) {
  const std::string blocks = "l { " + leaf + "} l 2 { " + leaf + "} l 7 { " + leaf + "}";
  EXPECT_THAT(blocks_of(test::plant_of("[l][l][l]" + ("\n" + blocks)), OrganKind::leaf),
              ElementsAre(0, 1, 0));
  // Two organs share label 7; number 2 labels nothing, so it is the second leaf of all.
  EXPECT_THAT(blocks_of(test::plant_of("[l(7)][l][l(7)]\n" + blocks), OrganKind::leaf), ElementsAre(2, 1, 2));
  // Number 2 labels the first leaf: the second one falls back to the block for all.
  EXPECT_THAT(blocks_of(test::plant_of("[l(2)][l][l(7)]\n" + blocks), OrganKind::leaf), ElementsAre(1, 0, 2));
  // A label without a block of its own leaves the ordinal.
  EXPECT_THAT(blocks_of(test::plant_of("[l][l(9)][l]\n" + blocks), OrganKind::leaf), ElementsAre(0, 1, 0));
  // Ordinals count each letter by itself.
  EXPECT_THAT(blocks_of(test::plant_of("s[+l]s[+l]\nl 2 {" + leaf + "} s 2 { a_length 1 a_radius 1 }"),
                        OrganKind::stem),
              ElementsAre(-1, 1));
}

TEST(PlantLanguage, NotesWhatIsUnusedMissingOrAmbiguous) {
  EXPECT_THAT(test::plant_of("[l][l]\nl 1 {" + leaf + "}").warnings,
              ElementsAre("x.bpms:1:5: leaf 2 has no block and no extent"));
  EXPECT_THAT(test::plant_of("+l\nl {" + leaf + "}").warnings,
              ElementsAre("x.bpms:1:1: rotation 1 has no block and turns nothing"));
  EXPECT_THAT(test::plant_of("l\nl {" + leaf + "}\nl 5 {" + leaf + "}").warnings,
              ElementsAre("x.bpms:3:1: nothing uses the block 'l 5'"));
  EXPECT_THAT(test::plant_of("[l][l(1)]\nl {" + leaf + "}").warnings,
              ElementsAre(HasSubstr(
                  "x.bpms:1:5: 1 is a label here and also the ordinal of another leaf (line 1, column 2)")));
  EXPECT_THAT(test::plant_of("[l(1)][l]\nl {" + leaf + "}").warnings,
              IsEmpty());  // its own ordinal: no ambiguity
  EXPECT_THAT(test::plant_of("l\nl { a_length 3 }").warnings,
              ElementsAre("x.bpms:2:1: this leaf has no a_width and no surface"));
  const std::string bare = " { a_length 3 }\n";
  EXPECT_THAT(test::plant_of("[l][l][l]\nl 1" + bare + "l 2" + bare + "l 3" + bare).warnings,
              ElementsAre("x.bpms:2:1: this leaf has no a_width and no surface; the same at lines 3, 4"));
  EXPECT_THAT(test::plant_of("units m\nl\nl { a_length 1.2 a_width 0.1 }").warnings,
              ElementsAre("x.bpms:3:5: a leaf 1.2 m long; is the unit ('units m') right? With 'units cm' it "
                          "would be 1.2 cm"));
  EXPECT_THAT(test::plant_of("units m\nl\nl { a_length 1 a_width 0.1 }").warnings, IsEmpty());
}

TEST(PlantLanguage, NotesSizesThatNoPlantHas) {
  const auto notes = [](const std::string& text) { return test::plant_of(text).warnings; };
  // The unit that changes the number least is the one proposed.
  EXPECT_THAT(
      notes("units m l l {\n a_length 25 a_width 0.5 }"),
      ElementsAre("x.bpms:2:2: a leaf 25 m long; is the unit ('units m') right? With 'units cm' it would "
                  "be 25 cm"));
  EXPECT_THAT(
      notes("units mm l l { a_length 0.25 a_width 0.2 }"),
      ElementsAre(HasSubstr("x.bpms:1:16: a leaf 0.25 mm long; is the unit ('units mm') right? With 'units "
                            "cm' it would be 2.5 mm")));
  EXPECT_THAT(
      notes("units m s s { a_length 130 a_radius 1 }"),
      ElementsAre(HasSubstr("a stem 130 m long; is the unit ('units m') right? With 'units cm' it would be "
                            "1.3 m")));
  EXPECT_THAT(notes("units m b b { a_radius 2 }"),
              ElementsAre(HasSubstr("x.bpms:1:15: a bud 2 m in radius")));
  EXPECT_THAT(notes("units m h h { a_length 5000 a_radius 0.1 }"),
              ElementsAre(testing::EndsWith("is the unit ('units m') right?")));  // no unit helps
  EXPECT_THAT(
      notes("l l { a_length 3 a_width 4 }"),
      ElementsAre("x.bpms:1:18: a leaf wider (4 cm) than long (3 cm): are a_width and a_length as meant?"));
  EXPECT_THAT(notes("s s { a_length 3 a_radius 4 }"),
              ElementsAre(HasSubstr("x.bpms:1:18: a stem of larger radius (4 cm) than length (3 cm)")));
  EXPECT_THAT(notes("[l][s][h][b] l { a_length 100 a_width 3 } s { a_length 3 a_radius 3 } "
                    "h { a_length 10 a_radius 1 } b { a_radius 0.2 }"),
              IsEmpty());
}

TEST(PlantLanguage, TheExamplesRead) {
  for (const char* name : {"grass", "figure1", "figure1_leaves", "figure2_0", "figure2_45", "figure2_90",
                           "figure2_135", "figure2_180", "wheat", "fern"}) {
    const Plant plant = read_plant(std::string(BPMS_SOURCE_DIR) + "/examples/plants/" + name + ".bpms");
    EXPECT_THAT(plant.warnings, IsEmpty()) << name;
    EXPECT_EQ(plant.name, name);
  }
}

TEST(PlantLanguage, WritesTheCanonicalText) {
  const Plant plant = test::plant_of(
      "# c\n[s[+l(2)]] s{a_radius 0.1 a_length 12.0} l 2{f_twist f 10 -10 a_width 1.2 a_length 25 material "
      "leaf}+ 1 {a_twist 180}");
  EXPECT_EQ(plant_text(plant),
            "units cm\n[s[+l(2)]]\ns {\n  a_length 12\n  a_radius 0.1\n}\nl 2 {\n  material leaf\n  a_length "
            "25\n  a_width 1.2\n"
            "  f_twist f 10 -10\n}\n+ 1 {\n  a_twist 180\n}\n");
}

}  // namespace
}  // namespace bpms
