// Organs made of organs: definitions with parameters, their uses, where their parts come to stand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/units.h"
#include "plant/plant.h"
#include "plant/plant_mesh.h"
#include "tests/data.h"
#include "tests/plant/plant_text.h"

namespace bpms {
namespace {

using enum ErrorKind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string frond =
    "organ frond(len, pairs = 3) {\n"
    "  <s[+l][+l]>(pairs) l\n"
    "  s { a_length (len / pairs) a_radius 0.1 }\n"
    "  + { a_twist 90 }\n"
    "  l { material leaf a_length (len / 4) a_width (len / 10) a_inclination 60 }\n"
    "}\n";

std::vector<std::string> labels_of(const std::vector<PlacedOrgan>& organs) {
  std::vector<std::string> out;
  for (const PlacedOrgan& organ : organs) out.push_back(organ.label);
  return out;
}

TEST(Compound, PartsAreLabelledAndNumberedInOrder) {
  const Plant plant =
      test::plant_of(frond +
                     "[s[+c][c]l]\n"
                     "s { a_length 10 a_radius 0.2 } + { a_twist 180 } l { a_length 5 a_width 1 }\n"
                     "c 1 { organ frond len 12 pairs 1 } c 2 { organ frond len 6 pairs (1 + 1) }");
  EXPECT_THAT(plant.warnings, IsEmpty());
  const std::vector<PlacedOrgan> organs = place_organs(plant);
  EXPECT_THAT(labels_of(organs), ElementsAre("s1", "c1.s1", "c1.l1", "c1.l2", "c1.l3", "c2.s1", "c2.l1",
                                             "c2.l2", "c2.s2", "c2.l3", "c2.l4", "c2.l5", "l1"));
  for (std::size_t i = 0; i < organs.size(); ++i) {
    EXPECT_EQ(organs[i].id, static_cast<int>(i));
    EXPECT_EQ(plant.word[static_cast<std::size_t>(organs[i].symbol)].kind,
              organs[i].label.starts_with("c") ? OrganKind::compound : organs[i].kind);
  }
  EXPECT_DOUBLE_EQ(organs[1].attributes->length_m, 0.12);
  EXPECT_DOUBLE_EQ(organs[5].attributes->length_m, 0.03);
  const Mesh mesh = plant_mesh(plant, {1e-3});
  ASSERT_EQ(mesh.organs.size(), organs.size());
  EXPECT_EQ(mesh.organs[2].kind, "leaf");
  EXPECT_EQ(mesh.organs[1].kind, "stem");
  EXPECT_EQ(mesh.organs[2].material, "leaf");
  EXPECT_NEAR(mesh.organs[2].area_m2, 0.03 * 0.012, 1e-4 * 0.03 * 0.012);
}

// A compound organ is placed as if its word stood in a bracket of its own, turned by its constants.
TEST(Compound, StandsWhereItsWordWould) {
  const std::string inner =
      "s { a_length 3 a_radius 0.1 f_inclination n 0 10 1 40 } + { a_twist 70 a_inclination 20 }"
      " l { a_length 4 a_width 1 a_inclination 30 }";
  const Plant compound =
      test::plant_of("organ o { s[+l]l " + inner +
                     " } [s[+c]s] s { a_length 7 a_radius 0.2 a_inclination 15 } + { a_twist 120 }"
                     " c { organ o a_inclination 35 a_azimuth 5 a_twist 25 }");
  // The constants of the compound organ are a rotation before its word; organs of its own blocks have labels.
  const Plant plain = test::plant_of(
      "[s[+(1)[+(2) s(8)[+(3)l(8)]l(8)]]s]\n"
      "s { a_length 7 a_radius 0.2 a_inclination 15 } + 1 { a_twist 120 }"
      " + 2 { a_inclination 35 a_azimuth 5 a_twist 25 } + 3 { a_twist 70 a_inclination 20 }"
      " s 8 { a_length 3 a_radius 0.1 f_inclination n 0 10 1 40 }"
      " l 8 { a_length 4 a_width 1 a_inclination 30 }");
  const std::vector<PlacedOrgan> a = place_organs(compound), b = place_organs(plain);
  ASSERT_EQ(a.size(), 5u);
  ASSERT_EQ(b.size(), 5u);
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_LT((a[i].plant_from_organ.matrix() - b[i].plant_from_organ.matrix()).cwiseAbs().maxCoeff(), 1e-12)
        << a[i].label;
}

TEST(Compound, OrgansOfOrgansNest) {
  const Plant plant = test::plant_of(
      "organ pair(w) { [l][+l] l { a_length (2 * w) a_width (w) } + { a_twist 180 } }\n"
      "organ spray(n, w = 1) { <s[c]>(n) s { a_length 2 a_radius 0.1 } c { organ pair w (w / 2) } }\n"
      "[c][c] c 1 { organ spray n 2 } c 2 { organ spray n 1 w 3 }");
  EXPECT_THAT(labels_of(place_organs(plant)),
              ElementsAre("c1.s1", "c1.c1.l1", "c1.c1.l2", "c1.s2", "c1.c2.l1", "c1.c2.l2", "c2.s1",
                          "c2.c1.l1", "c2.c1.l2"));
  EXPECT_DOUBLE_EQ(place_organs(plant)[1].attributes->width_m, 0.005);
  EXPECT_DOUBLE_EQ(place_organs(plant)[7].attributes->width_m, 0.015);
  // Equal values share their organ; what it is made of stands before it.
  EXPECT_EQ(plant.compounds.size(), 4u);
  EXPECT_EQ(plant.compounds[0].name, "pair");
  EXPECT_EQ(plant.compounds[1].name, "spray");
}

TEST(Compound, IsWrittenWithItsNumbersAndReadBack) {
  const Plant plant =
      test::plant_of(frond +
                     "organ frond_2 { l l { a_length 1 a_width 1 } }\n"
                     "[c][c][c][c] c 1 { organ frond len 12 a_twist 20 p_age 3 } c 2 { organ frond len 8 }"
                     " c 3 { organ frond_2 } c 4 { organ frond len 12 }");
  const std::string text = plant_text(plant);
  EXPECT_THAT(text, HasSubstr("organ frond {\ns[+l][+l]s[+l][+l]s[+l][+l]l\ns {\n  a_length 4\n"));
  EXPECT_THAT(text, HasSubstr("c 1 {\n  organ frond\n  a_twist 20\n  p_age 3\n}\n"));
  EXPECT_THAT(text, HasSubstr("c 2 {\n  organ frond_3\n}\n"));  // frond_2 is another's name
  EXPECT_THAT(text, HasSubstr("c 4 {\n  organ frond\n}\n"));
  const Plant again = test::plant_of(text);
  EXPECT_EQ(plant_text(again), text);
  EXPECT_THAT(again.warnings, IsEmpty());
  const std::vector<PlacedOrgan> a = place_organs(plant), b = place_organs(again);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].label, b[i].label);
    EXPECT_EQ(a[i].properties, b[i].properties);
    EXPECT_TRUE(a[i].plant_from_organ.isApprox(b[i].plant_from_organ, 1e-14));
  }
}

TEST(Compound, ParametersAreChecked) {
  EXPECT_REFUSED(frond + "c c { organ frond }",
                 "x.bpms:7:13: semantic error: organ 'frond' lacks len (defined at x.bpms:1:7)");
  EXPECT_REFUSED(frond + "c c { organ frond len 3 pair 4 }",
                 "x.bpms:7:25: semantic error: organ 'frond' has no parameter 'pair'; did you mean 'pairs'?");
  EXPECT_REFUSED(frond + "c c { organ frond len 3 len 4 }",
                 "x.bpms:7:25: semantic error: a second 'len' in one block");
  EXPECT_REFUSED(frond + "c c { organ front len 3 }",
                 "x.bpms:7:13: semantic error: unknown organ 'front'; did you mean 'frond'?");
  EXPECT_REFUSED(frond + "c c { len 3 }", "x.bpms:7:3: semantic error: this block does not say which organ");
  EXPECT_REFUSED("c c { organ x }", "unknown organ 'x'; organs are defined before the word");
  EXPECT_REFUSED(frond + "c c { organ frond len 3 a_length 3 }",
                 "a compound has no a_length; it has a_inclination");
  EXPECT_REFUSED("organ o(a, a) { s } s", "x.bpms:1:12: semantic error: a second parameter 'a'");
  EXPECT_REFUSED("organ o(a_twist) { s } s", "x.bpms:1:9: semantic error: 'a_twist' is an attribute");
  EXPECT_REFUSED("organ o(a b) { s } s", "x.bpms:1:11: syntax error: found 'b', expected ','");
  EXPECT_REFUSED("organ o(a,) { s } s", "expected another parameter");
  EXPECT_REFUSED("organ o(a { s } s",
                 "x.bpms:1:8: syntax error: list of parameters opened here is never closed");
  EXPECT_REFUSED("organ o { s { s", "x.bpms:1:9: syntax error: organ opened here is never closed");
  EXPECT_REFUSED("organ o { s } organ o { s } s", "x.bpms:1:21: semantic error: a second organ 'o'");
  EXPECT_REFUSED("organ o { s { a_length 3 } } c", "x.bpms:1:11: syntax error: no word in this organ");
  EXPECT_REFUSED("organ o { } s", "no word in this organ");
  EXPECT_REFUSED(
      "cs", "x.bpms:1:2: semantic error: 's' after 'c' in the same bracket: nothing grows from a compound");
  // A value that its organ cannot take is told at the attribute that it comes to.
  EXPECT_REFUSED(frond + "c c { organ frond len -3 }",
                 "x.bpms:3:16: semantic error: a_length is -1, expected a size");
  EXPECT_REFUSED(frond + "c c { organ frond len 3 pairs 1.5 }",
                 "x.bpms:2:14: semantic error: a group is repeated 1.5 times");
}

TEST(Compound, UnusedDefinitionsAreCheckedToo) {
  EXPECT_REFUSED("organ o(a) { l l { a_length (b) } } s", "x.bpms:1:30: semantic error: unknown name 'b'");
  EXPECT_REFUSED("organ o { l l { a_lenght 3 } } s", "unknown attribute 'a_lenght'");
  EXPECT_REFUSED("organ o { l l { a_length (b) } } let b = 3 s",
                 "x.bpms:1:27: semantic error: 'b' is used before its definition at x.bpms:1:38");
  // What depends on a parameter is not known before the organ is used.
  EXPECT_NO_THROW(test::plant_of(
      "organ o(n) { <s>(n) s { a_length (1 / n) f_twist n 0 (n) 1 (sqrt(n)) a_radius (n) } } s"));
  EXPECT_REFUSED("organ o(n) { s s { a_length (1 / 0 + n) } } s", "division by zero");
}

TEST(Compound, ParametersHideConstants) {
  const Plant plant = test::plant_of(
      "let len = 1 organ o(len) { l l { a_length (len) a_width 1 } } c c { organ o len (len + 6) }");
  EXPECT_DOUBLE_EQ(place_organs(plant)[0].attributes->length_m, 0.07);
}

TEST(Compound, RecursionIsRefusedWithItsChain) {
  EXPECT_REFUSED("organ a { c c { organ a } } s",
                 "x.bpms:1:23: semantic error: an organ cannot be a part of itself: a -> a");
  EXPECT_REFUSED("organ a { c c { organ b } }\norgan b { [c] c { organ d } }\norgan d { c c { organ b } } s",
                 "x.bpms:3:23: semantic error: an organ cannot be a part of itself: b -> d -> b");
  std::string deep = "organ o0 { s s { a_length 1 a_radius 0.1 } }\n";
  for (int i = 1; i < 40; ++i) deep += fmt::format("organ o{} {{ c c {{ organ o{} }} }}\n", i, i - 1);
  EXPECT_REFUSED(deep + "s", "more than 32 organs within each other");
}

TEST(Compound, ManyPartsAreRefusedBeforeTheyAreBuilt) {
  std::string text = "organ o0 { <s>(100) s { a_length 1 a_radius 0.1 } }\n";
  for (int i = 1; i < 8; ++i) text += fmt::format("organ o{} {{ <[c]>(100) c {{ organ o{} }} }}\n", i, i - 1);
  EXPECT_REFUSED(text + "c c { organ o7 }", "more than 1000000 organs");
  // Different values at each of many places.
  std::string doubling = "organ o0(x) { s s { a_length (1 + x) a_radius 0.1 } }\n";
  for (int i = 1; i < 25; ++i)
    doubling += fmt::format(
        "organ o{0}(x) {{ [c]c c 1 {{ organ o{1} x (2*x) }} c 2 {{ organ o{1} x (2*x+1) }} }}\n", i, i - 1);
  EXPECT_REFUSED(doubling + "c c { organ o24 x 0 }", "more than 100000 symbols in all");
}

TEST(Compound, NotesOfItsBlocksAreToldOnce) {
  const Plant plant = test::plant_of(
      "organ o(n) { [l][s] l { a_length (n) } }\n[c][c] c 1 { organ o n 1 } c 2 { organ o n 2 }");
  EXPECT_THAT(plant.warnings, ElementsAre("x.bpms:1:18: stem 1 has no block and no extent",
                                          "x.bpms:1:21: this leaf has no a_width and no surface"));
}

}  // namespace
}  // namespace bpms
