// points.csv, vectors.csv, other people's tables, and the rig.
#include "tests/apps/refused.h"

namespace bpms::test {
namespace {

Refusal points(const std::string& name, const std::string& what, const std::string& by,
               const std::string& begin, const std::vector<std::string>& holds = {}, int code = 2) {
  return {name, replaced("points.csv", what, by), reconstruct, code, "points.csv:" + begin, holds};
}
Refusal vectors(const std::string& name, const std::string& what, const std::string& by,
                const std::string& begin, const std::vector<std::string>& holds = {}) {
  return {name, replaced("vectors.csv", what, by), fit_vectors, 2, "vectors.csv:" + begin, holds};
}
Refusal leaves(const std::string& name, const std::string& what, const std::string& by,
               const std::string& begin, const std::vector<std::string>& holds = {}) {
  return {name, replaced("leaves.csv", what, by), fit_columns, 2, "leaves.csv:" + begin, holds};
}
Refusal columns(const std::string& name, const std::string& arguments, const std::string& begin,
                const std::vector<std::string>& holds = {}) {
  return {name, as_it_is(), "fit leaves.csv " + arguments + " -o new.bpms", 2, begin, holds};
}
Refusal rig(const std::string& name, const std::string& what, const std::string& by, const std::string& begin,
            const std::vector<std::string>& holds = {}) {
  return {name, replaced("rig.toml", what, by), reconstruct, 2, "rig.toml:" + begin, holds};
}

const std::string head = "plant,axis,rank,organ,feature,point,view,camera,u_px,v_px,sigma_px\n";
const std::string vector_head = "plant,axis,rank,organ,feature,point,x_m,y_m,z_m,xx,xy,xz,yy,yz,zz\n";

INSTANTIATE_TEST_SUITE_P(
    Points, Refused,
    ::testing::ValuesIn(std::vector<Refusal>{
        Refusal{"Truncated",
                cut_behind("points.csv", "a,right,222"),
                reconstruct,
                2,
                "points.csv:5: ",
                {"9 fields, expected 11"}},
        Refusal{"OnlyAHeader", written("points.csv", head), reconstruct, 2, "points.csv: ", {"no points"}},
        points("NotANumber", "320,240", "nan,240", "2:28: ", {"'nan'", "'u_px'", "finite"}),
        points("HugeNumber", "320,240", "1e30,240", "2:28: ", {"'1e30'", "finite"}),
        points("OutsideTheImage", "320,240", "3200,240", "2:", {"3200", "outside", "640x480"}),
        points("DecimalComma", "320,240", "\"320,5\",240", "2:28: ", {"'320,5'", "finite"}),
        points("ZeroSigma", ",0.5\n", ",0\n", "2:36: ", {"sigma above 0"}),
        points("NegativeSigma", ",0.5\n", ",-0.5\n", "2:36: ", {"sigma above 0"}),
        points("TinySigma", ",0.5\n", ",1e-300\n", "2:36: ", {"sigma"}),
        points("NoOrgan", "leaf,", ",", "2:7: ", {"organ has no name"}),
        points("RankIsAWord", "1,1,1,", "1,1,one,", "2:5: ", {"'one'", "'rank'", "whole number"}),
        points("NegativeRank", "1,1,1,", "1,1,-1,", "2:5: ", {"rank -1"}),
        points("PointTwice", "a,right,220", "a,left,220", "3:", {"stands twice", "'left'"}),
        points("UnknownCamera", "a,right", "a,rihgt", "3:", {"no camera 'rihgt'", "'right'"}),
        points("NoCamera", "a,right", "a,", "3:", {"camera has no name"}),
        points("MisspeltColumn", "u_px", "u_pxl", "1: ", {"no column 'u_px'", "did you mean 'u_pxl'?"}),
        points("ColumnTwice", "v_px", "u_px", "1:", {"'u_px' stands twice"}),
        points("Semicolons", head, "plant;axis;rank;organ;feature;point;view;camera;u_px;v_px;sigma_px\n", "",
               {}),
        points("OpenQuote", "320,240", "\"320,240", "2:28: ", {"never closed"}),
        points("TwoFrames", "a,right", "b,right", "3:", {"view 'a'", "view 'b'"}),
        Refusal{"InOneImageOnly",
                written("points.csv", head + "1,1,1,leaf,midrib,1,a,left,320,240,0.5\n"),
                reconstruct,
                4,
                "points.csv: ",
                {"all 1 points were rejected", "seen in one image only"}},
        Refusal{
            "RaysThatDoNotMeet",
            written("points.csv",
                    head +
                        "1,1,1,leaf,midrib,1,a,left,320,240,0.5\n1,1,1,leaf,midrib,1,a,right,220,300,0.5\n"),
            reconstruct,
            4,
            "points.csv: ",
            {"all 1 points were rejected", "chi2"}},
        Refusal{"UnknownView",
                as_it_is(),
                reconstruct + " --view b",
                2,
                "points.csv: ",
                {"no point is of view 'b'"}},
        Refusal{"PhotographOfAnotherSize",
                blank_image("left.png", 320, 240),
                reconstruct + " --photographs left=left.png",
                2,
                "left.png: ",
                {"320x240", "640x480"}},
        Refusal{"PhotographIsNone",
                as_it_is(),
                reconstruct + " --photographs left=grass.bpms",
                2,
                "grass.bpms: ",
                {"not an image"}},
        Refusal{"PhotographAbsent",
                as_it_is(),
                reconstruct + " --photographs left=left.png",
                3,
                "left.png: no such file",
                {}},
        Refusal{"PhotographEmpty",
                written("left.png", ""),
                reconstruct + " --photographs left=left.png",
                2,
                "left.png: ",
                {"not an image"}},
        Refusal{"DisparityIsNone",
                as_it_is(),
                reconstruct + " --check-disparity grass.bpms",
                2,
                "grass.bpms: ",
                {"not an image"}},
        Refusal{"DisparityOfAnotherSize",
                blank_image("d.png", 64, 48),
                reconstruct + " --check-disparity d.png",
                2,
                "d.png: ",
                {"64x48"}},
        Refusal{"UpWithoutDirection", as_it_is(), reconstruct + " --up 0,0,0", 2, "--up: ", {"no direction"}},
        Refusal{
            "UpNotANumber", as_it_is(), reconstruct + " --up 0,nan,1", 2, "--up: ", {"'0,nan,1'", "X,Y,Z"}},
        Refusal{"NoSuchOrigin", as_it_is(), reconstruct + " --origin organ=bud", 2, "", {"organ=bud"}},
        Refusal{"NoPot", as_it_is(), reconstruct + " --up-from points.csv", 2, "", {"'pot'"}}}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    Vectors, Refused,
    ::testing::ValuesIn(std::vector<Refusal>{
        Refusal{"Truncated",
                cut_behind("vectors.csv", "midrib,3,0.018"),
                fit_vectors,
                2,
                "vectors.csv:5: ",
                {"7 fields, expected 15"}},
        Refusal{"OnlyAHeader",
                written("vectors.csv", vector_head),
                fit_vectors,
                2,
                "vectors.csv: ",
                {"no vectors"}},
        vectors("NotANumber", "0.002000", "nan", "3:21: ", {"'nan'", "'x_m'", "finite"}),
        vectors("HugeNumber", "0.002000", "1e30", "3:21: ", {"'1e30'"}),
        vectors("InMillimetres", "x_m,y_m,z_m", "x_mm,y_mm,z_mm",
                "1: ", {"no column 'x_m'", "did you mean 'x_mm'?"}),
        vectors("NegativeVariance", "1e-8", "-1e-8", "2:", {"not positive semi-definite"}),
        vectors("PartOfACovariance", ",zz\n", ",zzz\n", "1: ", {"no column 'zz'"}),
        vectors("MisspeltFeature", "midrib", "midrb", "2:", {"'midrb'", "did you mean 'midrib'?"}),
        vectors("PointTwice", "midrib,1,", "midrib,0,", "3:", {"point 0 stands twice"}),
        Refusal{"OnlyAnotherOrgan",
                written("vectors.csv", vector_head + "1,1,1,pot,rim,1,0,0,0,1,0,0,1,0,1\n"),
                fit_vectors,
                2,
                "vectors.csv: ",
                {"no leaf, stem or head"}},
        Refusal{"TooFewPoints",
                cut_behind("vectors.csv", "midrib,1,0.002000,0,0.029000,1e-8,0,0,1e-8,0,1e-8\n"),
                fit_vectors,
                2,
                "vectors.csv: ",
                {"none of the 1 organs", "2 midrib points"}},
        Refusal{
            "UnitWithVectors", as_it_is(), fit_vectors + " --unit cm", 2, "--unit goes with --columns", {}},
        Refusal{"UnknownFunction", as_it_is(), fit_vectors + " --function q:3", 2, "", {"'q:3'", "p:DEGREE"}},
        Refusal{"UnknownFunctionName",
                as_it_is(),
                fit_vectors + " --function inclnation=p:3",
                2,
                "",
                {"inclnation", "'inclination'"}},
        Refusal{"OrderZero", as_it_is(), fit_vectors + " --function n:0", 2, "", {"n:0"}},
        Refusal{"NegativeWidth", as_it_is(), fit_vectors + " --width -1cm", 2, "", {"--width"}},
        Refusal{"WidthWithoutUnit", as_it_is(), fit_vectors + " --width 1", 2, "", {"no unit"}}}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    Columns, Refused,
    ::testing::ValuesIn(std::vector<Refusal>{
        leaves("NotANumber", "1,0.00,0.00", "1,nan,0.00", "2:3: ", {"'nan'", "'x'", "finite"}),
        leaves("HugeNumber", "1,0.00,0.00", "1,1e30,0.00", "2:3: ", {"'1e30'"}),
        leaves("DecimalComma", "1,0.20,2.90", "1,0,20,2,90", "3: ", {"5 fields, expected 3"}),
        Refusal{"OnlyAHeader",
                written("leaves.csv", "leaf,x,y\n"),
                fit_columns,
                2,
                "leaves.csv: ",
                {"no points"}},
        columns("NoUnit", "--columns leaf=leaf,x=x,z=y", "--columns needs --unit", {}),
        columns("UnknownUnit", "--columns leaf=leaf,x=x,z=y --unit parsec", "", {"'parsec'", "known: m, cm"}),
        columns("UnknownColumn", "--columns leaf=leaf,x=x,z=zz --unit cm",
                "leaves.csv:1: ", {"no column 'zz'"}),
        columns("UnknownRole", "--columns leaf=leaf,x=x,zed=y --unit cm", "", {"'zed'", "--columns"}),
        columns("RoleTwice", "--columns leaf=leaf,x=x,x=y --unit cm", "", {"'x' stands twice"}),
        columns("NoX", "--columns leaf=leaf,z=y --unit cm", "", {"'x'"}),
        columns("NotAMapping", "--columns leaf --unit cm", "", {"ROLE=COLUMN"}),
        columns("UnknownDialect", "--columns leaf=leaf,x=x,z=y --unit cm --dialect de", "",
                {"'de'", "en (comma"}),
        columns("OtherDialect", "--columns leaf=leaf,x=x,z=y --unit cm --dialect fr",
                "leaves.csv:1: ", {"no column"}),
        columns("DialectAlone", "--dialect fr", "--dialect goes with --columns", {}),
        columns("SeveralPlantsInOneFile", "--columns plant=leaf,leaf=leaf,x=x,z=y --unit cm", "",
                {"2 plants", "-o plants/"})}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    Rig, Refused,
    ::testing::ValuesIn(std::vector<Refusal>{
        Refusal{"Truncated", cut_behind("rig.toml", "size_px = [640"), reconstruct, 2, "rig.toml:5:", {}},
        Refusal{"TruncatedBetweenKeys",
                cut_behind("rig.toml", "model = \"brown_conrady\"\n"),
                reconstruct,
                2,
                "rig.toml:3:",
                {"missing key 'parameters'"}},
        rig("WrongUnit", "units = \"m\"", "units = \"mm\"", "1:9: ", {"units", "'mm'"}),
        rig("PixelsFromTheCorner", "\"integer\"", "\"half\"", "2:16: ", {"'half'", "integer"}),
        rig("NotANumber", "[1000.0, 1000.0", "[nan, 1000.0", "7:15: ", {"finite"}),
        rig("HugeNumber", "[1000.0, 1000.0", "[1e300, 1000.0", "7:15: ", {"finite"}),
        rig("NegativeFocalLength", "[1000.0, 1000.0", "[-1000.0, 1000.0", "7:15: ", {"above 0"}),
        rig("ZeroFocalLength", "[1000.0, 1000.0", "[0, 1000.0", "7:15: ", {"above 0"}),
        rig("ZeroSize", "[640, 480]", "[0, 480]", "5:12: ", {"size_px"}),
        rig("HugeSize", "[640, 480]", "[640, 1e9]", "5:17: ", {"size_px"}),
        rig("FiveParameters", "320.0, 240.0]", "320.0, 240.0, 0.1]",
            "7:14: ", {"5 parameters", "4, 8, 9 or 12"}),
        rig("UnknownModel", "\"brown_conrady\"", "\"brown_conradi\"",
            "6:9: ", {"did you mean 'brown_conrady'?"}),
        rig("UnknownKey", "pixel_centre", "pixel_center", "2:1: ", {"did you mean 'pixel_centre'?"}),
        rig("NoRotation", "[[1, 0, 0, 0]", "[[2, 0, 0, 0]", "8:16: ", {"no rotation"}),
        rig("Reflection", "[[1, 0, 0, 0]", "[[-1, 0, 0, 0]", "8:16: ", {"reflection"}),
        rig("TwoCamerasOfOneName", "\"right\"", "\"left\"", "10:8: ", {"'left'"}),
        rig("UnknownParameter", "\"left.fx\"", "\"left.fz\"", "16:10: ", {"'left.fz'"}),
        rig("CovarianceNotSymmetric", "[0.5, 1.0]]", "[0.4, 1.0]]", "17:10: ", {"not symmetric"}),
        rig("CovarianceNotPositive", "[[1.0, 0.5], [0.5, 1.0]]", "[[1.0, 2.0], [2.0, 1.0]]",
            "17:10: ", {"not positive semidefinite"}),
        rig("CovarianceOfAnotherSize", "[[1.0, 0.5], [0.5, 1.0]]", "[[1.0]]",
            "17:10: ", {"expected 2 rows"})}),
    name_of_case);

}  // namespace
}  // namespace bpms::test
