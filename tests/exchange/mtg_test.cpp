// The MTG reader: measured files counted by other means, topology by hand, mistakes by their place.
#include "plant/mtg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <sstream>

#include "core/text.h"
#include "tests/data.h"

namespace bpms {
namespace {

using enum ErrorKind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

const char* const head =
    "CODE:\tFORM-A\n\nCLASSES:\nSYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\tDEFINITION\n"
    "$\t0\tFREE\tFREE\tIMPLICIT\nP\t1\tFREE\tFREE\tEXPLICIT\nA\t2\tFREE\tFREE\tEXPLICIT\n"
    "U\t3\tFREE\tFREE\tEXPLICIT\nL\t3\tFREE\tFREE\tEXPLICIT\n\n"
    "DESCRIPTION:\nLEFT\tRIGHT\tRELTYPE\tMAX\nU\tU,L\t+\t?\nU\tU\t<\t1\nA\tA\t+\t?\nA\tA\t<\t?\n\n"
    "FEATURES:\nNAME\tTYPE\nlen\tREAL\nn\tINT\nrem\tALPHA\nday\tDD/MM/YY\nalive\tBOOLEAN\n\n"
    "MTG:\nENTITY-CODE\t\t\t\tlen\tn\trem\tday\talive\n";

Mtg with_entities(const std::string& rows) {
  return parse_mtg("t.mtg", head + rows);
}
constexpr int first_row = 28;  // of the entities, behind `head`

int vertex_named(const Mtg& mtg, const std::string& label, int nth = 1) {
  for (std::size_t v = 0; v < mtg.vertices.size(); ++v)
    if (mtg.label(v) == label && --nth == 0) return static_cast<int>(v);
  ADD_FAILURE() << "no " << label;
  return 0;
}
std::string relation(const Mtg& mtg, int v) {
  const MtgVertex& vertex = mtg.vertices[static_cast<std::size_t>(v)];
  const auto name = [&](int other) {
    return other < 0 ? std::string("-") : mtg.label(static_cast<std::size_t>(other));
  };
  return name(vertex.parent) + vertex.edge + mtg.label(static_cast<std::size_t>(v)) + " in " +
         name(vertex.complex);
}

TEST(Mtg, PassesCommentsBehindSpaces) {
  const std::string text = std::string("  # digitised in spring\n\r#\r\n") + head + "/P1\n";
  EXPECT_EQ(parse_mtg("a.mtg", text).vertices.size(),
            parse_mtg("a.mtg", head + std::string("/P1\n")).vertices.size());
}

TEST(Mtg, TopologyByHand) {
  const Mtg mtg = with_entities(
      "/P1\n"
      "^/A1\n"
      "^/U1<U2\t\t\t\t1.5\t2\told wood\t03/11/98\ttrue\n"
      "\t+A2/U1<<U3\t\t\t9\n"  // borne by U2 at scale 3, by A1 at scale 2
      "\t\t+L1\n"
      "\t^<U4\n"
      "^<A3/U1\n"  // from U2: its axis is followed, and so is U2
      "/P2/A1/U1\n");
  ASSERT_EQ(mtg.vertices.size(), 15u);
  EXPECT_EQ(relation(mtg, vertex_named(mtg, "U2")), "U1<U2 in A1");
  EXPECT_EQ(relation(mtg, vertex_named(mtg, "A2")), "A1+A2 in P1");
  EXPECT_EQ(relation(mtg, vertex_named(mtg, "U1", 2)), "U2+U1 in A2");
  EXPECT_EQ(relation(mtg, vertex_named(mtg, "U3")), "U2<U3 in A2");
  EXPECT_EQ(relation(mtg, vertex_named(mtg, "L1")), "U3+L1 in A2");
  EXPECT_EQ(relation(mtg, vertex_named(mtg, "U4")), "U3<U4 in A2");
  EXPECT_EQ(relation(mtg, vertex_named(mtg, "A3")), "A1<A3 in P1");
  EXPECT_EQ(relation(mtg, vertex_named(mtg, "U1", 3)), "U2<U1 in A3");
  EXPECT_EQ(relation(mtg, vertex_named(mtg, "P2")), "-/P2 in -");
  EXPECT_EQ(relation(mtg, vertex_named(mtg, "U1", 4)), "-/U1 in A1");
  const auto u2 = static_cast<std::size_t>(vertex_named(mtg, "U2"));
  EXPECT_EQ(mtg.number(u2, mtg.feature("len")), 1.5);
  EXPECT_EQ(*mtg.text(u2, *mtg.feature("rem")), "old wood");
  EXPECT_EQ(*mtg.text(u2, *mtg.feature("day")), "03/11/98");
  // << gives its values to the last entity of the range alone.
  EXPECT_EQ(mtg.number(static_cast<std::size_t>(vertex_named(mtg, "U3")), mtg.feature("len")), 9);
  EXPECT_EQ(mtg.number(static_cast<std::size_t>(vertex_named(mtg, "U2", 2)), mtg.feature("len")),
            std::nullopt);
  EXPECT_THAT(mtg.notes, IsEmpty());
}

TEST(Mtg, RangeWithADotSharesItsValues) {
  const Mtg mtg = with_entities("/P1/A1/U1<.<U4\t\t\t\t2.5\n");
  for (int k = 1; k <= 4; ++k)
    EXPECT_EQ(
        mtg.number(static_cast<std::size_t>(vertex_named(mtg, "U" + std::to_string(k))), mtg.feature("len")),
        2.5)
        << k;
  EXPECT_EQ(mtg.number(1, mtg.feature("len")), std::nullopt);
  const Mtg borne = with_entities("/P1/A1/U1+.+U3\n");
  EXPECT_EQ(relation(borne, vertex_named(borne, "U3")), "U2+U3 in A1");
}

TEST(Mtg, LatinAndWindowsFilesAreConvertedAndNoted) {
  std::string text = std::string(head) + "/P1\n^/A1/U1\t\t\t\t\t\tch\xeane\n";
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
  const Mtg mtg = parse_mtg("t.mtg", text);
  EXPECT_EQ(*mtg.text(2, *mtg.feature("rem")), "ch\xc3\xaane");
  EXPECT_THAT(mtg.notes, ElementsAre(HasSubstr("Latin-1"), HasSubstr("CR LF")));
}

TEST(Mtg, RelationsThatTheDescriptionDoesNotNameAreNoted) {
  const Mtg mtg = with_entities("/P1/A1/U1+L1\n\t<L2\n\t<L3\n");
  EXPECT_THAT(mtg.notes, ElementsAre(HasSubstr("t.mtg:29: 2 relations")));  // L<L twice
}

struct Mistake {
  std::string rows;
  int line, column;
  std::string says;
};

TEST(Mtg, MistakesInEntitiesAreLocated) {
  for (const Mistake& m : std::vector<Mistake>{
           {"/P1\n\t\t/A1\n", 2, 3, "no entity stands above in column 2"},
           {"/P1\n\t^/A1\n", 2, 2, "no entity stands above in column 2"},
           {"/P1\n\t\t\t\t/A1\n", 2, 5, "'/A1' stands in column 5, but entity codes end with column 4"},
           {"/P1\n^/A1\t\t7\n", 2, 7, "'7' between the code and the values, which begin with column 5"},
           {"/P1\t\t\t\t\t\t\t\t\tx\n", 1, 13, "'x' in column 10, but the last column is 9 (alive)"},
           {"/P1\n^/A1/V1\n", 2, 6, "unknown class 'V'"},
           {"/P1\n^A1\n", 2, 2, "unknown relation in 'A1'"},
           {"/P1 1 2\n", 1, 4, "columns are separated by tabs"},
           {"/P1\n^/A1/U1\t\t\t\tlong\n", 2, 12, "found 'long', expected a value of type REAL in column len"},
           {"/P1\n^/A1/U1\t\t\t\t1\t1.5\n", 2, 14, "expected a value of type INT in column n"},
           {"/P1\n^/A1/U1\t\t\t\t\t\t\t1998\n", 2, 15, "expected a value of type DD/MM/YY in column day"},
           {"/P1\n^/A1/U1\t\t\t\t\t\t\t\tyes\n", 2, 16, "expected a value of type BOOLEAN"},
           {"/P1\n^<U1\n", 2, 2, "no entity of scale 3 before it that it could follow"},
           {"/P1\n^/A1/U5<<U3\n", 2, 8, "the range '<<U3' does not go on"},
           {"/P1\n^/A1/U1<<L3\n", 2, 8, "the range '<<L3' does not go on"},
           {"/P1\n^/A1/U1<<U999999999\n", 2, 8, "longer than"},
           {"/P1\n^/A1/U99999999999\n", 2, 7, "the index '99999999999'"},
           {"/P1\n^\n", 2, 1, "a code without an entity"},
           {"# nothing\n", 1, 0, "no entities"}}) {
    BPMS_EXPECT_ERROR(with_entities(m.rows), bad_input,
                      SourceLocation({"t.mtg", first_row - 1 + m.line, m.column}).str() + ": ");
    BPMS_EXPECT_ERROR(with_entities(m.rows), bad_input, m.says);
  }
}

TEST(Mtg, MistakesInTheHeadAreLocated) {
  const auto edited = [](const std::string& from, const std::string& to) {
    std::string text = std::string(head) + "/P1\n";
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  for (const auto& [from, to, says] : std::vector<std::array<std::string, 3>>{
           {"CODE:\tFORM-A", "CODE:\tFORM-B", "t.mtg:1:7: the code 'FORM-B'"},
           {"CLASSES:", "CLASS:", "t.mtg:3:1: found 'CLASS:', expected the section CLASSES:"},
           {"A\t2\tFREE", "A\ttwo\tFREE", "t.mtg:7:3: found 'two', expected the scale of class 'A'"},
           {"L\t3\t", "U\t3\t", "t.mtg:9:1: the class 'U' is there already"},
           {"DESCRIPTION:\n", "", "t.mtg:11:1: missing section: DESCRIPTION: must stand before 'LEFT'"},
           {"U\tU,L\t+", "U\tU,K\t+", "t.mtg:13:3: unknown class 'K'"},
           {"U\tU,L\t+", "U\tU,L\t-", "t.mtg:13:9: unknown relation '-'"},
           {"FEATURES:\n", "", "t.mtg:18:1: missing section: FEATURES: must stand before 'NAME'"},
           {"n\tINT", "n\tINTEGR", "t.mtg:21:3: unknown type 'INTEGR'"},
           {"MTG:\n", "", "t.mtg:26:1: missing section: MTG: must stand before 'ENTITY-CODE'"},
           {"ENTITY-CODE", "ENTITIES", "t.mtg:27:1: found 'ENTITIES'"},
           {"\trem\tday", "\trme\tday", "is not among the FEATURES; did you mean 'rem'?"},
           {"\trem\tday", "\tlen\tday", "the column 'len' is there already"}})
    BPMS_EXPECT_ERROR(parse_mtg("t.mtg", edited(from, to)), bad_input, says);
  BPMS_EXPECT_ERROR(parse_mtg("t.mtg", std::string(head).substr(0, 40)), bad_input, "the file ends where");
}

// Counts entities per class by expressions on the bare text, ranges expanded.
std::map<std::string, int> counted(const std::string& text) {
  static const std::regex element("([/<+])(\\.?[<+])?([A-Za-z]+)([0-9]*)");
  std::map<std::string, int> out;
  std::istringstream lines(text);
  bool table = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("ENTITY-CODE") || line.starts_with("TOPO")) {
      table = true;
      continue;
    }
    const std::size_t begin = line.find_first_not_of('\t');
    if (!table || begin == std::string::npos || line[begin] == '#') continue;
    const std::string code = line.substr(begin, line.find('\t', begin) - begin);
    int before = 0;
    for (std::sregex_iterator at(code.begin(), code.end(), element), end; at != end; ++at) {
      const int index = (*at)[4].length() > 0 ? std::stoi((*at)[4]) : 0;
      out[(*at)[3]] += (*at)[2].matched ? index - before : 1;
      before = index;
    }
  }
  return out;
}
std::map<std::string, int> read_counts(const Mtg& mtg) {
  std::map<std::string, int> out;
  for (const MtgVertex& vertex : mtg.vertices) ++out[mtg.classes[vertex.symbol].symbol];
  return out;
}

class MeasuredMtg : public testing::TestWithParam<const char*> {};

TEST_P(MeasuredMtg, CountsAgreeAndWritingIsStable) {
  const std::string name = std::string("mtg-digitised/") + GetParam();
  BPMS_NEED_DATA(name);
  const std::string path = test::data_folder() + "/" + name;
  const Mtg mtg = read_mtg(path);
  EXPECT_EQ(read_counts(mtg), counted(read_text(path)));
  for (const std::string& note : mtg.notes) std::cout << note << "\n";
  const std::string written = mtg_text(mtg);
  const Mtg again = parse_mtg("again.mtg", written);
  EXPECT_TRUE(again.same_as(mtg));
  EXPECT_EQ(mtg_text(again), written);
}
INSTANTIATE_TEST_SUITE_P(Files, MeasuredMtg,
                         testing::Values("agraf.mtg", "boutdenoylum2.mtg", "braeburn.mtg", "wij10.mtg",
                                         "coffee-opf/coffee.mtg"),
                         [](const auto& file) {
                           std::string out;
                           for (const char c : std::string(file.param)) out += std::isalnum(c) ? c : '_';
                           return out;
                         });

TEST(Mtg, MeasuredFilesHoldWhatIsKnownOfThem) {
  BPMS_NEED_DATA("mtg-digitised");
  const std::string folder = test::data_folder() + "/mtg-digitised/";
  EXPECT_THAT(read_counts(read_mtg(folder + "wij10.mtg")), testing::Contains(Pair("P", 10)));
  EXPECT_THAT(read_counts(read_mtg(folder + "coffee-opf/coffee.mtg")),
              ElementsAre(Pair("Axis", 158), Pair("Individual", 1), Pair("Leaf", 2179), Pair("Metamer", 1853),
                          Pair("Scene", 1)));
  const Mtg walnut = read_mtg(folder + "boutdenoylum2.mtg");
  EXPECT_EQ(walnut.number(1, walnut.feature("ZZ")), -27.23);  // /A1, its first row of values
  EXPECT_EQ(walnut.number(2, walnut.feature("TopDia")), 180);
}

TEST(Mtg, DeepAxesNeedNoStack) {
  std::string rows = "/P1\n^/A1/U1\n";
  for (int k = 2; k <= 100'000; ++k) rows += fmt::format("^<U{}\t\t\t\t1\n", k);
  const Mtg mtg = with_entities(rows);
  EXPECT_EQ(mtg.vertices.size(), 100'002u);
  const std::string written = mtg_text(mtg);
  EXPECT_EQ(mtg_text(parse_mtg("again.mtg", written)), written);
  std::string branches = "/P1\n^/A1/U1\n";  // each borne by the one before: one column does
  for (int k = 2; k <= 20'000; ++k) branches += "^+U1\n";
  const Mtg deep = with_entities(branches);
  EXPECT_TRUE(parse_mtg("again.mtg", mtg_text(deep)).same_as(deep));
}

}  // namespace
}  // namespace bpms
