// Formulas of soils and thick canopies against published values, and what every lobe promises.
#include "core/csv.h"
#include "core/text.h"
#include "simulate/materials/hapke.h"
#include "simulate/materials/rpv.h"
#include "simulate/materials/verstraete_pinty_dickinson.h"
#include "tests/materials/lobe_checks.h"

namespace bpms::test {
namespace {

const char* const brdf_values = "analytic/brdf_reference_values.csv";

// A row of the reference: relative azimuth 0 is the view on the sun's side.
struct ReferenceRow {
  std::map<std::string, double> parameters;
  Eigen::Vector3d view, light;
  double brf;
};

Eigen::Vector3d exact_direction(double zenith_deg, double azimuth_deg) {
  const double z = radians(zenith_deg), a = radians(azimuth_deg);
  return {std::sin(z) * std::cos(a), std::sin(z) * std::sin(a), std::cos(z)};
}

std::vector<ReferenceRow> rows_of(const std::string& model) {
  std::string text = read_text(data_folder() + "/" + brdf_values);
  text.erase(0, text.find('\n') + 1);  // a comment above the header, and another table below
  text.erase(std::min(text.find("\n#"), text.size() - 1) + 1);
  const CsvTable table = CsvTable::parse(brdf_values, text);
  std::vector<ReferenceRow> out;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (!table.text(row, table.require("model")).starts_with(model)) continue;
    ReferenceRow add;
    std::istringstream words{std::string(table.text(row, table.require("params")))};
    for (std::string word; words >> word;)
      if (const std::size_t equals = word.find('='); equals != std::string::npos)
        add.parameters[word.substr(0, equals)] = *parse_number(word.substr(equals + 1));
    add.light = exact_direction(table.number(row, table.require("sza")), 0);
    add.view =
        exact_direction(table.number(row, table.require("vza")), table.number(row, table.require("phi")));
    add.brf = table.number(row, table.require("BRF"));
    out.push_back(add);
  }
  return out;
}

// 1e-6, or half of the last of the eight digits that the file has.
double reference_tolerance(double brf) {
  return std::max(1e-6 * brf, 0.5e-8 * 1.01);
}

TEST(Rpv, HasThePublishedValues) {
  BPMS_NEED_DATA(brdf_values);
  const std::vector<ReferenceRow> rows = rows_of("RPV");
  EXPECT_EQ(rows.size(), 120u);
  for (const ReferenceRow& row : rows) {
    const auto& p = row.parameters;
    const double brf = rpv_brf({p.at("rho0"), p.at("k"), p.at("Theta"), p.at("rhoc")},
                               reflection_angles(row.view, row.light));
    EXPECT_NEAR(brf, row.brf, reference_tolerance(row.brf));
  }
}

TEST(VerstraetePintyDickinson, HasThePublishedValues) {
  BPMS_NEED_DATA(brdf_values);
  const std::vector<ReferenceRow> rows = rows_of("VPD1990");
  EXPECT_EQ(rows.size(), 90u);
  for (const ReferenceRow& row : rows) {
    const auto& p = row.parameters;
    VpdParameters set{.w = p.at("w"), .radius_m = p.at("r"), .density = p.at("Lambda")};
    set_goudriaan(set, p.at("chil"));
    set.multiple = p.at("ms") != 0;
    const int phase = static_cast<int>(p.at("phase"));
    set.phase = {phase == 0   ? PhaseFunction::isotropic
                 : phase == 1 ? PhaseFunction::henyey_greenstein
                              : PhaseFunction::legendre,
                 p.at("a1"), p.at("a1"), p.at("a2")};
    const double brf = vpd_brf(set, reflection_angles(row.view, row.light));
    EXPECT_NEAR(brf, row.brf, reference_tolerance(row.brf)) << p.at("ms");
  }
}

// Chandrasekhar's H by Hapke's rational formula, at values that need no computer.
TEST(Hapke, HasItsClosedForms) {
  const Eigen::Vector3d nadir(0, 0, 1), slant = exact_direction(60, 0);
  // w = 1: H(x) = 1 + 2x; nadir, no hot spot: (1/4) / 2 * (1 + 9 - 1).
  EXPECT_NEAR(hapke_brf({1, 0, 0.1, {}}, reflection_angles(nadir, nadir)), 9.0 / 8, 1e-12);
  // In the hot spot B = B0 whatever h; w = 0.75: H(1) = 3/2, H(1/2) = 4/3, mu + mu0 = 1.
  EXPECT_NEAR(hapke_brf({0.75, 0.6, 0.05, {}}, reflection_angles(slant, slant)),
              0.75 / 4 * (1.6 + 16.0 / 9 - 1), 1e-12);
  // At g = 90 degrees tan(g/2) = 1; Henyey-Greenstein gives (1 - T^2) / (1 + T^2)^1.5.
  const Eigen::Vector3d left = exact_direction(45, 180), right = exact_direction(45, 0);
  const double h = (1 + std::sqrt(2.0)) / (1 + std::sqrt(2.0) * 0.5);
  EXPECT_NEAR(hapke_brf({0.75, 0.6, 0.5, {PhaseFunction::henyey_greenstein, -0.3, 0, 0}},
                        reflection_angles(left, right)),
              0.75 / 4 / std::sqrt(2.0) * ((1 + 0.6 / 3) * 0.91 / std::pow(1.09, 1.5) + h * h - 1), 1e-12);
}

TEST(Phase, FunctionsHaveTheMeanOne) {
  for (const ScatteringPhase& phase : {ScatteringPhase{PhaseFunction::henyey_greenstein, -0.4, 0, 0},
                                       ScatteringPhase{PhaseFunction::legendre, 0, 0.6, 0.3}}) {
    double sum = 0;
    constexpr int n = 100'000;
    for (int i = 0; i < n; ++i) sum += phase((2 * i + 1.0) / n - 1) / n;
    EXPECT_NEAR(sum, 1, 1e-8);
    EXPECT_GT(phase(1), phase(-1));  // scatters back
  }
}

const std::string soil_rpv = "type = \"rpv\"\nrho0 = [[600, 0.08], [700, 0.2]]\nk = 0.75\ntheta = -0.1\n";
const std::string phase_hg = "phase = \"henyey_greenstein\"\nasymmetry = [[600, -0.3], [700, 0.1]]\n";
const std::string soil_hapke =
    "type = \"hapke\"\nw = [[600, 0.3], [700, 0.7]]\nb0 = 0.8\nh = 0.1\n" + phase_hg;
const std::string soil_vpd =
    "type = \"verstraete_pinty_dickinson\"\nw = [[600, 0.2], [700, 0.9]]\nsunfleck_radius_m = 0.1\n"
    "area_density_m2_m3 = 1.0\n" +
    phase_hg;

TEST(Rpv, IsSeparableWhereOnlyRho0IsSpectral) {
  const Material soil = material_of(soil_rpv + "rhoc = 0.5", {600, 700});
  EXPECT_TRUE(soil.opaque);
  ASSERT_EQ(soil.lobes.size(), 1u);
  EXPECT_TRUE(soil.lobes[0].lobe->separable());
  EXPECT_EQ(soil.lobes[0].spectrum, (std::vector<double>{0.08, 0.2}));
  const Material three = material_of(soil_rpv, {600, 700});  // rhoc = rho0
  EXPECT_FALSE(three.lobes[0].lobe->separable());
  EXPECT_TRUE(three.lobes[0].spectrum.empty());
  const ReflectionAngles angles =
      reflection_angles(direction(30, 0).cast<double>(), direction(50, 100).cast<double>());
  for (std::size_t band = 0; band < 2; ++band) {
    const double rho0 = band == 0 ? 0.08 : 0.2;
    EXPECT_NEAR(values_of(soil.lobes[0], direction(30, 0), direction(50, 100), 2)[band],
                rpv_brf({rho0, 0.75, -0.1, 0.5}, angles) / pi, 1e-6);
    EXPECT_NEAR(values_of(three.lobes[0], direction(30, 0), direction(50, 100), 2)[band],
                rpv_brf({rho0, 0.75, -0.1, rho0}, angles) / pi, 1e-6);
  }
}

TEST(Soils, MayBeOnOneFace) {
  EXPECT_EQ(material_of(soil_rpv).lobes[0].on_face, (std::array<bool, 2>{true, true}));
  EXPECT_EQ(material_of(soil_rpv + "face = \"back\"").lobes[0].on_face, (std::array<bool, 2>{false, true}));
}

TEST(Soils, DrawWhatTheySay) {
  const auto check = [](const std::string& body, const LobeLimits& limits) {
    check_lobe(body, material_of(body, {600, 700}).lobes[0], 2, limits);
  };
  check(soil_rpv + "rhoc = 0.5", {.largest_weight = 3});
  check(
      "type = \"rpv\"\nrho0 = [[600, 0.08], [700, 0.2]]\nk = [[600, 0.4], [700, 1.1]]\n"
      "theta = [[600, -0.3], [700, 0.1]]\nrhoc = 1.0\n",
      {.largest_weight = 5});
  check("type = \"rpv\"\nrho0 = 0.02\nk = 0.6\ntheta = -0.6\nrhoc = 0.0\n",
        {.largest_weight = 5});  // far from flat
  check(soil_hapke, {.largest_weight = 4});
  check(soil_vpd, {.largest_weight = 4, .reciprocal = false});
  check(soil_vpd + "kappa = \"dickinson\"\nchi = 0.4\nmultiple_scattering = false\n",
        {.largest_weight = 4, .reciprocal = false});
}

// Not by a wrong formula: sun and view may not be exchanged in it.
TEST(VerstraetePintyDickinson, IsNotReciprocal) {
  VpdParameters p{.w = 0.6, .radius_m = 0.1, .density = 1};
  set_goudriaan(p, 0);
  const Eigen::Vector3d sun = exact_direction(60, 0), view = exact_direction(0, 0);
  EXPECT_GT(std::abs(vpd_brf(p, reflection_angles(view, sun)) / vpd_brf(p, reflection_angles(sun, view)) - 1),
            1e-3);
}

TEST(Rpv, OfMoreThanAllLightIsNotedWithItsAngle) {
  const Material bright = material_of("type = \"rpv\"\nrho0 = 0.6\nk = 0.5\ntheta = -0.3\nrhoc = 0.6");
  ASSERT_EQ(bright.notes.size(), 1u);
  EXPECT_THAT(bright.notes[0], ::testing::HasSubstr("at 85 degrees in band 1 (650 nm)"));
  EXPECT_TRUE(material_of(soil_rpv).notes.empty());
}

TEST(Soils, OutsideTheirParametersAreRefused) {
  struct Case {
    std::string body;
    const char* message;
  };
  const Case cases[] = {
      {"type = \"rpv\"\nrho0 = 0.1\nk = 0.7", "missing key"},
      {"type = \"rpv\"\nrho0 = 0.1\nk = 0.7\ntheta = -1.0", "theta is -1"},
      {"type = \"rpv\"\nrho0 = 0.1\nk = -0.7\ntheta = 0.1", "k is -0.7"},
      {"type = \"hapke\"\nw = 1.1\nb0 = 1\nh = 0.1", "w is 1.1"},
      {"type = \"hapke\"\nw = 0.5\nb0 = 1\nh = 0.1\nphase = \"legendre\"\na1 = 2.0",
       "negative at cos g = -1"},
      {"type = \"hapke\"\nw = 0.5\nb0 = 1\nh = 0.1\nasymmetry = 0.1", "asymmetry"},
      {soil_vpd + "chi = 0.7", "chi"},
      {soil_vpd + "kappa = \"goudrian\"", "goudriaan"},
      {soil_rpv + "face = \"upper\"", "front"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.body);
    BPMS_EXPECT_ERROR(material_of(c.body), ErrorKind::bad_input, c.message);
  }
}

}  // namespace
}  // namespace bpms::test
