// PROSPECT: its plates against series and layers added one by one, its constituents, its table.
#include "simulate/materials/prospect_leaf.h"

#include <algorithm>

#include "core/text.h"
#include "simulate/materials/dielectric_surface.h"
#include "simulate/materials/exponential_integral.h"
#include "simulate/materials/prospect_table.h"
#include "tests/materials/materials_of.h"

namespace bpms::test {
namespace {

const char* const pro_table = "optics/jbferet-prosail/dataSpec_PRO_v2.txt";
constexpr double cone = 40 * pi / 180;

TEST(ExponentialIntegral, HasTheTabulatedValues) {
  // Abramowitz & Stegun 1964, table 5.1.
  const std::pair<double, double> known[] = {
      {0.01, 4.037929576538}, {0.1, 1.822923958419},     {0.5, 0.559773594776},   {1.0, 0.219383934396},
      {2.0, 0.048900510708},  {10.0, 4.156968929685e-6}, {20.0, 9.8355252906e-11}};
  for (const auto& [x, value] : known)
    EXPECT_NEAR(exponential_integral(x), value, 1e-11 * value + 5e-13 * (x < 9)) << x;
  // Series and fraction meet.
  EXPECT_NEAR(exponential_integral(1.0), exponential_integral(1.0 + 1e-12), 1e-12);
}

// Light followed to and fro in one plate.
PlateOptics plate_by_series(double n, double k) {
  const double enter = cone_transmittance(cone, n), leave = cone_transmittance(pi / 2, n) / (n * n);
  const double through = plate_transmittance(k);
  PlateOptics out{1 - enter, 0};
  double inside = enter * through;  // at the lower side first
  for (int turn = 0; turn < 400; ++turn) {
    (turn % 2 == 0 ? out.transmittance : out.reflectance) += inside * leave;
    inside *= (1 - leave) * through;
  }
  return out;
}

TEST(Prospect, OfOneLayerIsThePlate) {
  for (const double n : {1.1, 1.3, 1.52})
    for (const double k : {0.0, 1e-4, 0.05, 0.7, 5.0}) {
      const PlateOptics leaf = prospect_leaf(1, n, k, cone), plate = plate_by_series(n, k);
      EXPECT_NEAR(leaf.reflectance, plate.reflectance, 1e-12) << n << " " << k;
      EXPECT_NEAR(leaf.transmittance, plate.transmittance, 1e-12) << n << " " << k;
    }
}

TEST(Prospect, OfThreeLayersIsThreePlatesAdded) {
  for (const double k : {1e-6, 0.01, 0.3, 2.0}) {
    const double n = 1.45;
    const PlateOptics first = prospect_leaf(1, n, k, cone), other = prospect_leaf(1, n, k, pi / 2);
    // Below the first: two more, and then its own transmittance back up, that of isotropic light.
    const auto add = [](const PlateOptics& top, const PlateOptics& back, const PlateOptics& below) {
      const double between = 1 - back.reflectance * below.reflectance;
      return PlateOptics{
          top.reflectance + top.transmittance * below.reflectance * back.transmittance / between,
          top.transmittance * below.transmittance / between};
    };
    const PlateOptics added = add(first, other, add(other, other, other));
    const PlateOptics leaf = prospect_leaf(3, n, k, cone);
    EXPECT_NEAR(leaf.reflectance, added.reflectance, 1e-11) << k;
    EXPECT_NEAR(leaf.transmittance, added.transmittance, 1e-11) << k;
  }
}

TEST(Prospect, LosesNothingWithoutAbsorption) {
  for (const double layers : {1.0, 1.5, 2.3, 5.0})
    for (const double n : {1.0, 1.27, 1.5}) {
      const PlateOptics clear = prospect_leaf(layers, n, 0, cone);
      EXPECT_NEAR(clear.reflectance + clear.transmittance, 1, 1e-9);
      EXPECT_GE(clear.transmittance, 0);
      // And no jump where the general form takes over.
      const PlateOptics nearly = prospect_leaf(layers, n, 1e-9, cone);
      EXPECT_NEAR(nearly.transmittance, clear.transmittance, 1e-7);
      EXPECT_NEAR(nearly.reflectance, clear.reflectance, 1e-7);
    }
  const PlateOptics black = prospect_leaf(2, 1.4, 2000, cone);
  EXPECT_EQ(black.transmittance, 0);
  EXPECT_NEAR(black.reflectance, 1 - cone_transmittance(cone, 1.4), 1e-12);
}

class ProspectLeaf : public ::testing::Test {
 protected:
  static std::string with(const std::string& content) {
    return "type = \"prospect\"\ncoefficients = \"" + data_folder() + "/" + pro_table +
           "\"\nn_layers = 1.5\n" + content;
  }
  static double light_of(const Material& leaf, std::size_t band) {
    return leaf.reflectance[0][band] + leaf.transmittance[band];
  }
};
const std::string green = "cab_ug_cm2 = 40\ncar_ug_cm2 = 8\ncw_cm = 0.012\ncm_g_cm2 = 0.007\n";

// The authors' own program (prospect_pro_matlab, main_Run_PROSPECT_PRO) for N = 1.2, Cab = 30, Car = 10, Ant
// = 1, Cw = 0.015, Cm = 0.009, Prot = 0.001, CBC = 0.009: dry matter counted twice, which our reader refuses.
TEST_F(ProspectLeaf, HasThePublishedSpectrum) {
  BPMS_NEED_DATA(pro_table);
  const ProspectTable table = read_prospect_table(data_folder() + "/" + pro_table);
  const LeafContent content{30, 10, 1, 0, 0.015, 0.009, 0.001, 0.009};
  struct Row {
    double nm, reflectance, transmittance;
  };
  const Row rows[] = {
      {400, 0.0430792297170304, 0.000186638539586644}, {450, 0.04106687462002674, 0.002512630004713102},
      {550, 0.1200014983311994, 0.1836195824526825},   {700, 0.1225037099859695, 0.2011863964659245},
      {760, 0.3417998973144463, 0.4813716047430826},   {1940, 0.02205985629556384, 0.02437338827249286},
      {2200, 0.06653712765501169, 0.184473865392991}};
  for (const Row& row : rows) {
    const auto at =
        static_cast<std::size_t>(std::find(table.nm.begin(), table.nm.end(), row.nm) - table.nm.begin());
    ASSERT_LT(at, table.nm.size());
    double k = 0;
    for (std::size_t i = 0; i < leaf_constituents; ++i) k += content[i] * table.absorption[i][at] / 1.2;
    const PlateOptics leaf = prospect_leaf(1.2, table.refractive_index[at], k, cone);
    EXPECT_NEAR(leaf.reflectance, row.reflectance, 1e-10) << row.nm;
    EXPECT_NEAR(leaf.transmittance, row.transmittance, 1e-10) << row.nm;
  }
}

TEST_F(ProspectLeaf, GivesOutNoMoreThanItReceivesAnywhere) {
  BPMS_NEED_DATA(pro_table);
  std::vector<double> nm;
  for (int i = 400; i <= 2500; i += 5) nm.push_back(i);
  for (const char* content : {"cab_ug_cm2 = 0\ncw_cm = 0\ncm_g_cm2 = 0\n", green.c_str()}) {
    const Material leaf = material_of(with(content), nm);
    EXPECT_EQ(leaf.reflectance[0], leaf.reflectance[1]);
    EXPECT_FALSE(leaf.opaque);
    EXPECT_TRUE(leaf.is_diffuse());
    const bool clear = content != green;
    for (std::size_t band = 0; band < nm.size(); ++band) {
      if (clear)
        EXPECT_NEAR(light_of(leaf, band), 1, 1e-9) << nm[band];
      else
        EXPECT_LT(light_of(leaf, band), 1) << nm[band];
      EXPECT_GT(leaf.reflectance[0][band], 0);
    }
  }
}

TEST_F(ProspectLeaf, AbsorbsMoreWithMoreOfEachWhereItAbsorbs) {
  BPMS_NEED_DATA(pro_table);
  struct Case {
    const char* key;
    double less, more, nm;
    const char* rest;
  };
  const std::string base = "cab_ug_cm2 = 30\ncw_cm = 0.01\ncm_g_cm2 = 0.005\n";
  const Case cases[] = {
      {"cab_ug_cm2", 20, 40, 670, "cw_cm = 0.01\ncm_g_cm2 = 0.005\n"},
      {"car_ug_cm2", 2, 10, 480, base.c_str()},
      {"ant_ug_cm2", 0, 5, 550, base.c_str()},
      {"brown", 0, 1, 600, base.c_str()},
      {"cw_cm", 0.005, 0.02, 1450, "cab_ug_cm2 = 30\ncm_g_cm2 = 0.005\n"},
      {"cm_g_cm2", 0.002, 0.01, 2100, "cab_ug_cm2 = 30\ncw_cm = 0.001\n"},
      {"prot_g_cm2", 0.0002, 0.002, 2180, "cab_ug_cm2 = 30\ncw_cm = 0.001\ncbc_g_cm2 = 0.004\n"},
      {"cbc_g_cm2", 0.001, 0.01, 2100, "cab_ug_cm2 = 30\ncw_cm = 0.001\nprot_g_cm2 = 0.001\n"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.key);
    const auto leaf = [&](double amount) {
      return material_of(with(fmt::format("{}{} = {}\n", c.rest, c.key, amount)), {c.nm});
    };
    const Material less = leaf(c.less), more = leaf(c.more);
    EXPECT_GT(less.reflectance[0][0], more.reflectance[0][0]);
    EXPECT_GT(less.transmittance[0], more.transmittance[0]);
  }
}

TEST_F(ProspectLeaf, InterpolatesItsTable) {
  BPMS_NEED_DATA(pro_table);
  const Material three = material_of(with(green), {700, 700.5, 701});
  EXPECT_GT(three.reflectance[0][1], three.reflectance[0][0]);  // up the red edge
  EXPECT_LT(three.reflectance[0][1], three.reflectance[0][2]);
  BPMS_EXPECT_ERROR(material_of(with(green), {650, 390}), ErrorKind::bad_input,
                    "from 400 to 2500 nm, which do not hold band 2 (390 nm)");
}

TEST_F(ProspectLeaf, InTheWrongUnitIsRefusedWithTheRightOne) {
  BPMS_NEED_DATA(pro_table);
  struct Case {
    const char* content;
    const char* message;
  };
  const Case cases[] = {
      {"cab_ug_cm2 = 40\ncw_cm = 10\ncm_g_cm2 = 0.005",
       "cw_cm is 10: expected 0 to 0.2 cm, the same as g cm-2"},
      {"cab_ug_cm2 = 40\ncw_cm = 0.01\ncm_g_cm2 = 10", "cm_g_cm2 is 10: expected 0 to 0.1 g cm-2"},
      {"cab_ug_cm2 = 400\ncw_cm = 0.01\ncm_g_cm2 = 0.005", "cab_ug_cm2 is 400: expected 0 to 200 ug cm-2"},
      {"cab_ug_cm2 = -1\ncw_cm = 0.01\ncm_g_cm2 = 0.005", "cab_ug_cm2 is -1"},
      {"cab_ug_cm2 = nan\ncw_cm = 0.01\ncm_g_cm2 = 0.005", "scene.toml:5"},
      {"cab_ug_cm2 = 40\ncm_g_cm2 = 0.005", "cw_cm"},
      {"cab_ug_cm2 = 40\ncw_cm = 0.01", "expected cm_g_cm2, or prot_g_cm2 and cbc_g_cm2"},
      {"cab_ug_cm2 = 40\ncw_cm = 0.01\ncm_g_cm2 = 0.005\nprot_g_cm2 = 0.001", "make up the dry matter"},
      {"cab_ug_cm2 = 40\ncw_cm = 0.01\ncm_g_cm2 = 0.005\nantho = 0.001", "antho"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.content);
    BPMS_EXPECT_ERROR(material_of(with(c.content)), ErrorKind::bad_input, c.message);
  }
}

TEST(ProspectTableFile, MayHaveFewerColumnsInAnyOrder) {
  const ProspectTable five = parse_prospect_table(
      "p5.txt",
      "# PROSPECT-5\nlambda, refractive_index, Kab, Kcar, Kbrown, Kw, Km, other\n"
      "400, 1.5, 0.06, 0.17, 0.5, 0.0001, 100, 7\n401, 1.4, 0.07, 0.18, 0.4, 0.0002, 101, 8\n");
  EXPECT_EQ(five.nm, (std::vector<double>{400, 401}));
  EXPECT_EQ(five.refractive_index[1], 1.4);
  EXPECT_EQ(five.absorption[0][1], 0.07);
  EXPECT_EQ(five.absorption[5][0], 100);
  EXPECT_TRUE(five.absorption[2].empty());
  const TemporaryFolder folder;
  folder.write("p5.txt",
               "lambda nrefrac sac_chl sac_car sac_brown sac_ewt sac_lma\n"
               "600 1.45 0.02 0 0 0.0001 5\n700 1.44 0.01 0 0 0.0002 4\n");
  const std::string leaf =
      "type = \"prospect\"\ncoefficients = \"p5.txt\"\nn_layers = 1.5\ncab_ug_cm2 = 40\ncw_cm = "
      "0.01\ncm_g_cm2 = 0.005\n";
  const Material read = material_of(folder, leaf);
  // The middle of both rows: the plate model by hand.
  const double k = (40 * 0.015 + 0.01 * 0.00015 + 0.005 * 4.5) / 1.5;
  EXPECT_NEAR(read.reflectance[0][0], prospect_leaf(1.5, 1.445, k, cone).reflectance, 1e-12);
  EXPECT_NEAR(read.transmittance[0], prospect_leaf(1.5, 1.445, k, cone).transmittance, 1e-12);
  BPMS_EXPECT_ERROR(material_of(folder, leaf + "ant_ug_cm2 = 2"), ErrorKind::bad_input, "no column sac_ant");
}

TEST(ProspectTableFile, WithMistakesGetsOneLine) {
  const std::string header = "lambda nrefrac sac_chl\n";
  struct Case {
    std::string text;
    const char* message;
  };
  const Case cases[] = {
      {"400 1.5 0.06\n", "no column lambda"},
      {"lambda sac_chl\n400 0.1\n", "no column nrefrac"},
      {"lambda nrefrac Lambda\n", "t.txt:1:16: 'Lambda' is a second column"},
      {header, "no rows"},
      {header + "400 1.5\n", "t.txt:2: 2 values in 3 columns"},
      {header + "400 1.5 1 1\n", "t.txt:2:11: more values than the 3 columns"},
      {header + "400 1.5 x\n", "t.txt:2:9: expected a number"},
      {header + "400 1.5 -1\n", "t.txt:2:9: found -1"},
      {header + "400 0.5 1\n", "refractive index 0.5"},
      {header + "400 1.5 1\n399 1.5 1\n", "t.txt:3:1: wavelength 399 nm does not come after 400 nm"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    BPMS_EXPECT_ERROR(parse_prospect_table("t.txt", c.text), ErrorKind::bad_input, c.message);
  }
  const TemporaryFolder folder;
  folder.write("um.txt", header + "0.4 1.5 1\n2.5 1.4 1\n");
  BPMS_EXPECT_ERROR(material_of(folder,
                                "type = \"prospect\"\ncoefficients = \"um.txt\"\nn_layers = 1.5\ncab_ug_cm2 "
                                "= 0\ncw_cm = 0\ncm_g_cm2 = 0\n"),
                    ErrorKind::bad_input, "look like micrometres: expected nm");
}

}  // namespace
}  // namespace bpms::test
