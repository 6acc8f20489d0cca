// Plants (.bpms) and canopies (canopy.toml) that are refused.
#include "tests/apps/refused.h"

namespace bpms::test {
namespace {

const Edit no_edit = as_it_is();

Refusal plant(const std::string& name, const Edit& spoil, const std::string& begin,
              const std::vector<std::string>& holds = {}) {
  return {name, spoil, build, 2, "grass.bpms:" + begin, holds};
}
Refusal stand(const std::string& name, const std::string& what, const std::string& by,
              const std::string& begin, const std::vector<std::string>& holds = {}) {
  return {name, replaced("canopy.toml", what, by), describe, 2, "canopy.toml:" + begin, holds};
}
Edit in_plant(const std::string& what, const std::string& by) {
  return replaced("grass.bpms", what, by);
}

INSTANTIATE_TEST_SUITE_P(
    Plant, Refused,
    ::testing::ValuesIn(std::vector<Refusal>{
        plant("TruncatedInABlock", cut_behind("grass.bpms", "a_width"), "5:40: ", {"ends", "a_width"}),
        plant("TruncatedBeforeABrace", cut_behind("grass.bpms", "a_radius 0.2"),
              "3:3: ", {"never closed", "'}'"}),
        plant("TruncatedInTheWord", cut_behind("grass.bpms", "[s[+l"),
              "2:3: ", {"opened at column 3", "never closed"}),
        plant("OpenBracket", in_plant("]h]", "]h"), "2:1: ", {"opened at column 1", "--lenient"}),
        plant("ClosedTooOften", in_plant("]h]", "]h]]"), "2:9: ", {"never opened"}),
        plant("UnknownUnit", in_plant("units cm", "units cn"), "1:7: ", {"'cn'", "did you mean 'cm'?"}),
        plant("NotANumber", in_plant("12", "nan"), "3:29: ", {"'nan'", "a_length", "finite number"}),
        plant("Infinite", in_plant("12", "inf"), "3:29: ", {"'inf'", "finite number"}),
        plant("BeyondDoubles", in_plant("12", "1e999"), "3:29: ", {"'1e999'", "finite number"}),
        plant("HugeLength", in_plant("12", "1e9"), "3:29: ", {"a_length", "at most 10000 m"}),
        plant("ZeroLength", in_plant("12", "0"), "3:29: ", {"a_length is 0", "above 0"}),
        plant("NegativeRadius", in_plant("0.2", "-0.2"), "3:42: ", {"a_radius is -0.2", "above 0"}),
        plant("DecimalComma", in_plant("0.2", "0,2"), "3:42: ", {"'0,2'", "finite number"}),
        plant("UnitBehindANumber", in_plant("12 ", "12cm "), "3:29: ", {"'12cm'"}),
        plant("TwoBlocksForOneOrgan",
              in_plant("h { material head  a_length 6  a_radius 0.4 }", "l { a_length 3 }"),
              "6:1: ", {"second block 'l'", "line 5"}),
        plant("UnknownAttribute", in_plant("a_width", "a_widht"),
              "5:33: ", {"'a_widht'", "did you mean 'a_width'?"}),
        plant("AttributeOfAnotherOrgan", in_plant("a_width", "a_radius"),
              "5:33: ", {"a leaf has no a_radius"}),
        plant("AttributeTwice", in_plant("a_width", "a_length"), "5:33: ", {"second 'a_length'"}),
        plant("UnknownFunction", in_plant(" p 15", " q 15"), "5:60: ", {"'q'", "p (power series)"}),
        plant("UpperCaseFunction", in_plant(" p 15", " P 15"), "5:60: ", {"did you mean 'p'?"}),
        plant("FunctionWithoutNumbers", in_plant(" 15 40 30", ""), "5:60: ", {"no numbers"}),
        plant("KnotsThatDoNotRise", in_plant("p 15 40 30", "n 0 1 0 2 1 1"), "5:60: ", {"does not rise"}),
        plant("NoMaterialName", in_plant("material leaf ", "material"), "5:", {"expected a material's name"}),
        plant("UnknownLetter", in_plant("]h]", "]x]"), "2:7: ", {"'x'", "b s l h c +"}),
        plant("OrganBehindALeaf", in_plant("+l]h", "+lh]"), "2:6: ", {"nothing grows from a leaf"}),
        plant("BlocksWithoutAWord", in_plant("[s[+l]h]\n", ""), "2:1: ", {"no word"}),
        Refusal{"ToleranceWithoutUnit", no_edit, build + " --tolerance 0.1", 2, "", {"'0.1' has no unit"}},
        Refusal{"ToleranceOfAnUnknownUnit",
                no_edit,
                build + " --tolerance 1parsec",
                2,
                "",
                {"'parsec'", "known: m, cm"}},
        Refusal{"NegativeTolerance", no_edit, build + " --tolerance -1mm", 2, "", {"--tolerance", "'-1mm'"}},
        Refusal{"UnknownMeshFormat", no_edit, "build grass.bpms -o new.stl", 2, "", {"new.stl", ".ply"}},
        Refusal{"TwoKindsOneBad", no_edit, build + " --also new.gl", 2, "", {"new.gl"}}}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    Canopy, Refused,
    ::testing::ValuesIn(std::vector<Refusal>{
        Refusal{"Truncated", cut_behind("canopy.toml", "size_m = [1.0"), describe, 2, "canopy.toml:2:", {}},
        Refusal{"TruncatedTables",
                cut_behind("canopy.toml", "{ type = \"uniform\" }\n"),
                "check canopy.toml",
                2,
                "canopy.toml",
                {}},
        stand("UnknownKey", "density_per_m2", "densty_per_m2",
              "11:1: ", {"'densty_per_m2'", "'density_per_m2'"}),
        stand("UnknownTable", "[planting]", "[plantin]", "8:2: ", {"'plantin'", "did you mean 'planting'?"}),
        stand("UnknownPattern", "\"rows\"", "\"row\"", "9:11: ", {"'row'", "did you mean 'rows'?"}),
        stand("ZeroSize", "[1.0, 1.0]", "[0.0, 1.0]", "2:10: ", {"size_m", "above 0"}),
        stand("NegativeSize", "[1.0, 1.0]", "[1.0, -1.0]", "2:10: ", {"size_m", "above 0"}),
        stand("NotANumberSize", "[1.0, 1.0]", "[nan, 1.0]", "2:11: ", {"size_m", "finite"}),
        stand("HugeSize", "[1.0, 1.0]", "[1e300, 1.0]", "2:11: ", {"size_m", "finite"}),
        stand("LargeSize", "[1.0, 1.0]", "[1e12, 1e12]", "2:10: ", {"up to 1e7 m"}),
        stand("ManyRows", "[1.0, 1.0]", "[1e7, 1e7]", "10:17: ", {"plants in the domain"}),
        stand("OneSize", "[1.0, 1.0]", "[1.0]", "2:10: ", {"expected 2"}),
        stand("SizeAsText", "[1.0, 1.0]", "\"1 m\"", "2:10: ", {"size_m"}),
        stand("HugeDensity", "8.0", "1e12", "11:18: ", {"density_per_m2"}),
        stand("ZeroDensity", "8.0", "0", "11:18: ", {"density_per_m2", "above 0"}),
        stand("NegativeSpacing", "0.5", "-0.5", "10:17: ", {"row_spacing_m", "above 0"}),
        stand("TinySpacing", "0.5", "1e-9", "10:17: ", {"row_spacing_m"}),
        stand("ScaleThatReachesZero", "sd = 0.05", "sd = 0.5", "6:9: ", {"scale", "reach zero"}),
        stand("UnknownRotation", "\"uniform\"", "\"unifrom\"", "7:21: ", {"did you mean 'uniform'?"}),
        stand("NegativeProbability", "file = \"grass.bpms\"", "file = \"grass.bpms\"\nprobability = -1",
              "6:15: ", {"probability"}),
        stand("NoProbability", "file = \"grass.bpms\"", "file = \"grass.bpms\"\nprobability = 0", "",
              {"probability above 0"}),
        stand("NoPlants", "[[plants]]\nfile = \"grass.bpms\"", "[x]", "", {"plants"}),
        Refusal{"PlantOfAnotherKind",
                replaced("canopy.toml", "grass.bpms", "leaf.obj"),
                describe,
                2,
                "leaf.obj:1:1: ",
                {"unknown letter"}},
        stand("KeyTwice", "pattern = \"rows\"", "pattern = \"rows\"\npattern = \"list\"", "10:", {"pattern"}),
        stand("OpenQuote", "\"rows\"", "\"rows", "9:", {}),
        Refusal{"AbsentPlant",
                replaced("canopy.toml", "grass", "gras"),
                describe,
                3,
                "gras.bpms: no such file",
                {}},
        Refusal{"EmptyFolderOfPlants",
                replaced("canopy.toml", "file = \"grass.bpms\"", "folder = \"none\""),
                describe,
                2,
                "canopy.toml:5:10: ",
                {"no .bpms files in 'none'"}},
        Refusal{"BadPlantInside", in_plant("]h]", "]h"), describe, 2, "grass.bpms:2:1: ", {"never closed"}}}),
    name_of_case);

}  // namespace
}  // namespace bpms::test
