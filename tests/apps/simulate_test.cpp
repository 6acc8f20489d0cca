// bpms simulate by hand: limits of memory, sensors that stand badly, diffuse fractions, files of other
// programs, the example of the report page.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "core/csv.h"
#include "core/json.h"
#include "tests/apps/refused.h"
#include "tests/command.h"

namespace bpms::test {
namespace {

using ::testing::HasSubstr;

Refusal with(const std::string& name, const Edit& spoil, const std::string& options, const std::string& begin,
             const std::vector<std::string>& holds, int code = 2) {
  return {name, spoil, simulate + options, code, begin, holds};
}
const Edit a_large_image =
    replaced("planted.toml", "width_px = 4\nheight_px = 4", "width_px = 4000\nheight_px = 4000");
const std::string planted_scene = "simulate planted.toml -o new.nc";

INSTANTIATE_TEST_SUITE_P(
    Memory, Refused,
    ::testing::ValuesIn(std::vector<Refusal>{
        with("OfTheScene", as_it_is(), " --memory 100B", "",
             {"tracing this scene needs", "the limit is", "prototype 'crown'"}, 3),
        with("OfTheSceneByItsKey",
             replaced("scene.toml", "[sampling]", "[limits]\nmemory = \"100 B\"\n[sampling]"), "", "",
             {"tracing this scene needs", "prototype 'crown'"}, 3),
        Refusal{"OfAnImage",
                a_large_image,
                planted_scene + " --memory 64MiB",
                3,
                "",
                {"need some", "the limit is 0.0625 GiB", "the results of sensor 'above' (16000000 views"}},
        with("OfAMapOfFluxes",
             replaced("scene.toml", "[bands]",
                      "[[sensors]]\nname = \"f\"\ntype = \"flux\"\nmap_px = [4000, 4000]\n[bands]"),
             " --memory 1GiB", "", {"the fluxes of sensor 'f' (4000 x 4000 pixels"}, 3),
        with("WithoutAUnit", as_it_is(), " --memory 4", "--memory: ", {"no unit", "4GiB"}),
        with("OfAnUnknownUnit", as_it_is(), " --memory 4Gb", "--memory: ", {"'Gb'", "GiB"}),
        with("KeyIsANumber", replaced("scene.toml", "[sampling]", "[limits]\nmemory = 4\n[sampling]"), "",
             "scene.toml:29:10: ", {"limits.memory", "expected a text"}),
        with("KeyIsMisspelt",
             replaced("scene.toml", "[sampling]", "[limits]\nmemroy = \"4 GiB\"\n[sampling]"), "",
             "scene.toml:29:1: ", {"'memroy'", "did you mean 'memory'?"})}),
    name_of_case);

TEST(Memory, ALimitThatIsNotReachedChangesNothing) {
  const SoundFolder folder;
  ASSERT_EQ(run_bpms(folder, "simulate scene.toml -o a.nc --csv a.csv").code, 0);
  const Outcome run = run_bpms(folder, "simulate scene.toml -o b.nc --csv b.csv --memory 1GiB");
  ASSERT_EQ(run.code, 0) << run.error;
  EXPECT_EQ(read_file(folder / "a.csv"), read_file(folder / "b.csv"));
}

// A ball of 0.2 m at 0.5 m above the ground.
Edit a_ball_and(const std::string& sensor) {
  return both(
      both(written("ball.txt", "sphere 0 0 0.5 0.2 soil\n"),
           replaced("scene.toml", "discs = \"crown.def\"\nmaterial = \"leaf\"", "shapes = \"ball.txt\"")),
      replaced("scene.toml", "name = \"nadir\"\ntype = \"brf\"\nviews = [[0.0, 0.0]]", sensor));
}
std::string camera_at(const std::string& location) {
  return "name = \"lost\"\ntype = \"perspective\"\nlocation = " + location +
         "\ndirection = [0, 1, 0]\nfov_deg = 20\nwidth_px = 4\nheight_px = 4";
}
INSTANTIATE_TEST_SUITE_P(
    Sensor, Refused,
    ::testing::ValuesIn(std::vector<Refusal>{
        with("InsideASolid", a_ball_and(camera_at("[0, 0, 0.5]")), "",
             "scene.toml:21:1: ", {"\"lost\" stands at (0, 0, 0.5) m", "inside a solid"}),
        with("InsideAnInstanceOfIt", a_ball_and(camera_at("[0.3, 0.2, 0.55]")), "",
             "scene.toml:21:1: ", {"\"lost\"", "inside a solid"}),
        with("BelowTheGround", a_ball_and(camera_at("[0.1, 0, -0.5]")), "",
             "scene.toml:24:12: ", {"sensors[0].location", "z = -0.5 m lies below the ground at 0 m"}),
        with("ARayOfAListInsideASolid",
             both(a_ball_and("name = \"lost\"\ntype = \"rays\"\nfile = \"rays.csv\""),
                  written("rays.csv",
                          "x_m,y_m,z_m,dx,dy,dz\n0.4,0,2,0,0,-1\n0.4,0,2,0,0,-1\n0,0,0.6,0,0,1\n")),
             "", "scene.toml:21:1: ", {"\"lost\" stands at (0, 0, 0.6) m", "inside a solid"}),
        with("ARayOfAListBelowTheGround",
             both(a_ball_and("name = \"lost\"\ntype = \"rays\"\nfile = \"rays.csv\""),
                  written("rays.csv",
                          "x_m,y_m,z_m,dx,dy,dz\n0.4,0,2,0,0,-1\n0.4,0,2,0,0,-1\n0.4,0,-1,0,0,1\n")),
             "", "rays.csv:4:7: ", {"z = -1 m lies below the ground at 0 m"}),
        // Over terrain that is known when it is read: a hill of 2 m in the middle.
        with("BelowTheTerrain",
             both(both(written(
                           "hill.asc",
                           "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 0.5\n0 0 0\n0 2 0\n0 0 0\n"),
                       replaced("scene.toml", "type = \"plane\"",
                                "type = \"dem\"\nfile = \"hill.asc\"\ncentred = true")),
                  a_ball_and(camera_at("[0, 0, 1.5]"))),
             "", "scene.toml:23:1: ", {"\"lost\" stands at (0, 0, 1.5) m", "below the ground"})}),
    name_of_case);

TEST(Sensor, OneBesideTheSolidIsTaken) {
  const SoundFolder folder;
  a_ball_and(camera_at("[0, 0.3, 0.5]"))(folder);
  EXPECT_EQ(run_bpms(folder, simulate).code, 0);
}

// Under sun and sky: so much on the horizontal from either.
Edit under_sun_and_sky(double direct, double diffuse) {
  const double normal = direct / std::cos(30 * std::numbers::pi / 180);
  return replaced(
      "scene.toml", "irradiance = \"brf\" }",
      fmt::format("irradiance = {:.12g} }}\nsky = {{ type = \"isotropic\", irradiance = {:.12g} }}", normal,
                  diffuse));
}
struct Found {
  double value = 0, error = 0;
};
Found found_in(const std::string& csv, const std::string& quantity) {
  const CsvTable table = CsvTable::parse("new.csv", csv);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const bool whole = table.text(row, table.require("order")).empty();
    const std::string_view origin = table.text(row, table.require("origin")),
                           component = table.text(row, table.require("component"));
    if (table.text(row, table.require("quantity")) == quantity && whole &&
        (origin.empty() || origin == "total") && (component.empty() || component == "all"))
      return {table.number(row, table.require("value")), table.number(row, table.require("standard_error"))};
  }
  ADD_FAILURE() << "no " << quantity << " in\n" << csv;
  return {};
}

TEST(DiffuseFraction, GivesWhatARunUnderThatSkyGives) {
  const SoundFolder folder;
  // 0.5 at 650 nm.
  folder.write("fraction.csv", "nm,fraction\n500,0.35\n800,0.65\n");
  const Edit large_leaves = written("crown.def", "0.3 0 0 0.5 0 0 1\n0.25 0.2 0 0.7 0 1 1\n");
  both(large_leaves, under_sun_and_sky(800, 100))(folder);
  for (const std::string fraction : {"0.5", "fraction.csv"}) {
    const Outcome run = run_bpms(
        folder, simulate + " --samples 65536 --overwrite --report new.json --diffuse-fraction " + fraction);
    ASSERT_EQ(run.code, 0) << run.error;
    const Found recombined = found_in(read_file(folder / "new.csv"), "hdrf_recombined");
    const SoundFolder other;
    both(large_leaves, under_sun_and_sky(450, 450))(other);
    ASSERT_EQ(run_bpms(other, simulate + " --samples 65536 --seed 2").code, 0);
    const Found direct = found_in(read_file(other / "new.csv"), "hdrf");
    EXPECT_LT(std::abs(recombined.value - direct.value), 4 * std::hypot(recombined.error, direct.error))
        << fraction << ": " << recombined.value << " and " << direct.value;
    EXPECT_LT(std::hypot(recombined.error, direct.error), 0.02 * direct.value);
    // It is another number than that of the run's own sky.
    const Found own = found_in(read_file(folder / "new.csv"), "hdrf");
    EXPECT_GT(std::abs(recombined.value - own.value), 4 * std::hypot(recombined.error, own.error));
  }
}

Refusal fraction(const std::string& name, const Edit& spoil, const std::string& given,
                 const std::string& begin, const std::vector<std::string>& holds, int code = 2) {
  return with(name, both(under_sun_and_sky(800, 100), spoil), " --diffuse-fraction=" + given, begin, holds,
              code);
}
INSTANTIATE_TEST_SUITE_P(
    DiffuseFraction, Refused,
    ::testing::ValuesIn(std::vector<Refusal>{
        fraction("AboveOne", as_it_is(), "1.2", "--diffuse-fraction", {"1.2", "from 0 to 1"}),
        fraction("Negative", as_it_is(), "-0.1", "--diffuse-fraction", {"from 0 to 1"}),
        fraction("NotANumber", as_it_is(), "nan", "nan: no such file", {}, 3),
        fraction("AbsentFile", as_it_is(), "none.csv", "none.csv: no such file", {}, 3),
        fraction("AFileOfNoise", written("f.csv", "\x01\x80 \xff"), "f.csv", "f.csv:", {}),
        fraction("AFileThatDoesNotReach", written("f.csv", "400,0.1\n500,0.2\n"), "f.csv", "",
                 {"400 to 500 nm", "650 nm"}),
        fraction("AFileAboveOne", written("f.csv", "400,10\n900,20\n"), "f.csv", "", {"from 0 to 1"}),
        with("WithoutASky", as_it_is(), " --diffuse-fraction 0.2", "--diffuse-fraction: ", {"sun and sky"})}),
    name_of_case);

// Fluxes under sun and sky: each by its origin too.
TEST(Fluxes, AreWrittenByOriginOfTheLight) {
  const SoundFolder folder;
  under_sun_and_sky(800, 100)(folder);
  replaced("scene.toml", "[bands]",
           "[[sensors]]\nname = \"energy\"\ntype = \"flux\"\nlayers = 3\n[bands]")(folder);
  const Outcome run = run_bpms(folder, simulate + " --samples 4096 --report new.html");
  ASSERT_EQ(run.code, 0) << run.error;
  for (const std::string name :
       {"energy_transmitted_direct", "energy_transmitted_by_origin", "energy_absorbed_layer_by_origin"})
    EXPECT_NE(read_file(folder / "new.nc").find(name), std::string::npos) << name;
  const CsvTable table = CsvTable::parse("new.csv", read_file(folder / "new.csv"));
  double of_all = 0, of_parts = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, table.require("quantity")) != "reflected") continue;
    const std::string_view origin = table.text(row, table.require("origin"));
    const double value = table.number(row, table.require("value"));
    if (origin == "total") of_all = value;
    if (origin == "direct") of_parts += 800 * value / 900;
    if (origin == "diffuse") of_parts += 100 * value / 900;
  }
  EXPECT_GT(of_all, 0);
  EXPECT_NEAR(of_parts, of_all, 1e-6);
}

// A camera over bare ground: all pixels are alike, so that the compressed result is small beside the cube.
const Edit bare_ground_image =
    both(replaced("scene.toml",
                  "[prototypes.crown]\ndiscs = \"crown.def\"\nmaterial = \"leaf\"\n[[instances]]\nprototype "
                  "= \"crown\"\npositions = \"places.def\"\n",
                  ""),
         replaced("scene.toml", "name = \"nadir\"\ntype = \"brf\"\nviews = [[0.0, 0.0]]",
                  "name = \"eye\"\ntype = \"orthographic\"\nlocation = [0, 0, 1]\ndirection = [0, 0, "
                  "-1]\nwidth_m = 1\nwidth_px = 300\nheight_px = 300"));

TEST(Output, ADiskLimitLeavesNoHalfOfACube) {
  const SoundFolder folder;
  bare_ground_image(folder);
  auto before = content_of(folder);
  const Outcome run = run_bpms(folder, "simulate scene.toml -o new.nc --samples 32 --envi cube --quiet",
                               "ulimit -f 500; ");  // 256 000 bytes; the cube has 360 000
  EXPECT_EQ(run.code, 3) << run.error;
  EXPECT_THAT(run.error, HasSubstr("error: cube_eye.img: cannot be written: File too large"));
  const auto after = content_of(folder);
  for (const auto& [path, content] : after)
    EXPECT_TRUE(before.contains(path) || path.ends_with("new.nc") || path.ends_with("new.png")) << path;
}

TEST(Output, ADiskLimitLeavesNoHalfOfAModelCheckersFile) {
  const SoundFolder folder;
  bare_ground_image(folder);
  replaced(
      "scene.toml",
      "name = \"eye\"\ntype = \"orthographic\"\nlocation = [0, 0, 1]\ndirection = [0, 0, -1]\nwidth_m = "
      "1\nwidth_px = 300\nheight_px = 300",
      "name = \"pp\"\ntype = \"brf\"\nplane = \"principal\"\nvza_deg = { from = -75, to = 75, step = 0.01 }")(
      folder);
  const auto before = content_of(folder);
  const Outcome run =
      run_bpms(folder, "simulate scene.toml -o new.nc --samples 32 --romc BARE --quiet", "ulimit -f 1200; ");
  EXPECT_EQ(run.code, 3) << run.error;
  EXPECT_THAT(run.error, HasSubstr("error: brfpp_bpms-BARE.mes: cannot be written: File too large"));
  for (const auto& [path, content] : content_of(folder))
    EXPECT_TRUE(before.contains(path) || path.ends_with("new.nc")) << path;
}

TEST(Examples, PolarRunsToItsEnd) {
  const TemporaryFolder folder;
  const std::string scene = std::string(BPMS_SOURCE_DIR) + "/examples/polar/scene.toml";
  const Outcome run = run_bpms(
      folder, "simulate '" + scene +
                  "' -o polar.nc --csv polar.csv --report polar.html --diffuse-fraction 0.2 --samples 32");
  ASSERT_EQ(run.code, 0) << run.error;
  EXPECT_THAT(run.error, HasSubstr("stopped by samples"));
  for (const char* file : {"polar.nc", "polar.html", "polar_fisheye.png"})
    EXPECT_GT(read_file(folder / file).size(), 10000u) << file;
  const std::string csv = read_file(folder / "polar.csv");
  const CsvTable table = CsvTable::parse("polar.csv", csv);
  std::map<std::string, int> totals;
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (table.text(row, table.require("quantity")) == "hdrf_recombined")
      ++totals[std::string(table.text(row, table.require("sensor")))];
  EXPECT_EQ(totals["principal plane"], 31 * 4);
  EXPECT_EQ(totals["hemisphere"], (1 + 6 * 24) * 4);
}

// The rows of HET01's principal plane, in the order and with the angles of the reference's.
TEST(Examples, Het01AsTheModelCheckerReadsIt) {
  BPMS_NEED_DATA("rami/het01/het01_UNI_sphere.def");
  const TemporaryFolder folder;
  const std::string data = std::filesystem::absolute(data_folder()).string() + "/rami/het01/";
  for (const char* file : {"het01_UNI_sphere.def", "het01_UNI_instances.def"})
    std::filesystem::create_symlink(data + file, folder / file);
  folder.write("scene.toml", read_file(std::string(BPMS_SOURCE_DIR) + "/examples/het01/scene.toml"));
  const Outcome run =
      run_bpms(folder, "simulate scene.toml -o out.nc --samples 1024 --romc HET01_DIS_UNI_NIR_20");
  ASSERT_EQ(run.code, 0) << run.error;
  std::string reference_text = read_file(data + "het01_brfpp_ref.csv");
  reference_text = reference_text.substr(reference_text.find("vza_deg"));
  const CsvTable reference = CsvTable::parse("het01_brfpp_ref.csv", reference_text);
  double sums[4][76] = {};
  const char* const kinds[] = {"brfpp", "brfpp_uc_sgl", "brfpp_co_sgl", "brfpp_mlt"};
  for (std::size_t kind = 0; kind < 4; ++kind) {
    std::istringstream in(read_file(folder / (std::string(kinds[kind]) + "_bpms-HET01_DIS_UNI_NIR_20.mes")));
    std::size_t rows = 0, columns = 0;
    double filtered = 0;
    in >> rows >> columns >> filtered;
    ASSERT_EQ(rows, 76u);
    ASSERT_EQ(rows, reference.rows());
    EXPECT_EQ(columns, 5u);
    EXPECT_EQ(filtered, -1);
    for (std::size_t row = 0; row < rows; ++row) {
      double sza = 0, vza = 0, turn = 0, brf = 0, error = 0;
      in >> sza >> vza >> turn >> brf >> error;
      ASSERT_TRUE(static_cast<bool>(in)) << kinds[kind] << " row " << row;
      const double signed_vza = reference.number(row, reference.require("vza_deg"));
      constexpr double degree = std::numbers::pi / 180, digits = 6e-7;
      EXPECT_NEAR(sza, 20 * degree, digits);
      EXPECT_NEAR(vza, std::abs(signed_vza) * degree, digits);
      EXPECT_NEAR(turn, signed_vza < 0 ? 0 : std::numbers::pi, digits);  // negative: the sun's side
      sums[kind][row] = brf;
      if (kind > 0) continue;
      const double expected = reference.number(row, reference.require("brf"));
      EXPECT_LT(std::abs(brf - expected), 4.5 * error + 0.001 * expected)
          << row;  // the reference's own error
      EXPECT_GT(error, 0);
      EXPECT_LT(error, 0.05 * expected);
    }
    std::string rest;
    EXPECT_FALSE(static_cast<bool>(in >> rest)) << rest;
  }
  for (std::size_t row = 0; row < 76; ++row)
    EXPECT_NEAR(sums[1][row] + sums[2][row] + sums[3][row], sums[0][row], 3e-6);
}

}  // namespace
}  // namespace bpms::test
