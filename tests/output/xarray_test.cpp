// Results in NetCDF as xarray opens them: dimensions, coordinates, units and values.
#include <gmock/gmock.h>

#include <sstream>

#include "simulate/forward/shared_views.h"
#include "simulate/output/output.h"
#include "simulate/output/quantity.h"
#include "tests/output/said_by.h"
#include "tests/simulate/scene_text.h"

namespace bpms::test {
namespace {

class NetcdfInXarray : public ::testing::Test {
 protected:
  void SetUp() override {
    if (said_by("/usr/bin/python3 -c 'import xarray, netCDF4; print(1)'") == "1\n") return;
    if (data_required()) FAIL() << "python3-xarray, python3-netcdf4 are absent: run scripts/setup";
    GTEST_SKIP() << "needs python3-xarray, python3-netcdf4";
  }
  // Of out.nc, opened as d.
  std::string said(const std::string& expressions) const {
    return said_by("/usr/bin/python3 -c 'import xarray as x; d = x.open_dataset(\"" + folder_ / "out.nc" +
                   "\"); print(" + expressions + ")'");
  }
  // Of a variable: dimensions, shape, names of its coordinates, its units and those of its error.
  std::string shape_of(const std::string& name) const {
    return said(
        fmt::format("d.{0}.dims, d.{0}.shape, sorted(d.{0}.coords), d.{0}.units, d.{0}_se.units, "
                    "d.{0}_se.dims == d.{0}.dims",
                    name));
  }
  // Every variable that has numbers says its unit.
  std::string without_units() const {
    return said("[n for n, v in d.variables.items() if v.dtype.kind == \"f\" and \"units\" not in v.attrs]");
  }
  std::vector<double> numbers(const std::string& expression) const {
    std::istringstream in(said("*[repr(float(v)) for v in " + expression + "]"));
    std::vector<double> out;
    for (std::string word; in >> word;) out.push_back(std::stod(word));
    return out;
  }
  Result write(const Simulation& simulation, const NetcdfOptions& options = {}) const {
    const Result result = simulate(simulation, 1);
    write_netcdf(simulation, result, {"bpms simulate", 1, {}}, folder_ / "out.nc", options);
    return result;
  }
  TemporaryFolder folder_;
};

const SceneText three_views{.soil = lambertian("[[400, 0.1], [900, 0.3]]"),
                            .sun = sun_at(40, 120),
                            .sensor = principal_plane("[-30, 0, 30]"),
                            .wavelengths_nm = "[650, 850]",
                            .sampling = "samples = 64"};

TEST_F(NetcdfInXarray, HasNamedCoordinates) {
  write(simulation_of(folder_, three_views));
  EXPECT_EQ(said("d.brf.dims, d.brf.shape, sorted(d.brf.coords), d.vza.units, d.wavelength.units, "
                 "[float(v) for v in d.vza.values], round(float(d.brf[1, 0]), 5), "
                 "float(d.brf_se[1, 0]) < 1e-6, d.attrs[\"stopped_by\"], d.brf_by_component.dims"),
            "('view', 'band') (3, 2) ['vaa', 'vza', 'wavelength'] degree nm [-30.0, 0.0, 30.0] 0.2 True "
            "samples ('view', 'band', 'component')\n");
  EXPECT_EQ(without_units(), "[]\n");
}

// Two images whose names are one when written as variables; by origin only when asked for.
TEST_F(NetcdfInXarray, HoldsImagesInSinglePrecision) {
  SceneText text = three_views;
  text.sky = white_sky;
  const std::string rest =
      "type = \"perspective\"\nlocation = [0, 0, 3]\nlook_at = [0.1, 0, 0]\nfov_deg = 20\nwidth_px = "
      "3\nheight_px = 2\n";
  text.sensor = "name = \"my camera\"\n" + rest + "[[sensors]]\nname = \"my-camera\"\n" + rest;
  const Simulation simulation = simulation_of(folder_, text);
  write(simulation);
  const std::string about =
      "d.my_camera_radiance.dtype, d.my_camera_radiance.shape, \"my_camera_2_radiance_se\" in d, "
      "\"my_camera_radiance_by_origin\" in d";
  EXPECT_EQ(said(about), "float32 (2, 3, 2) True False\n");
  write(simulation, {true, true});
  EXPECT_EQ(said(about), "float32 (2, 3, 2) True True\n");
  EXPECT_EQ(without_units(), "[]\n");
}

// Suns are told apart by name and by where they stand.
TEST_F(NetcdfInXarray, TellsSeveralSunsApart) {
  SceneText text = canopy_text(folder_, {.lai = 1, .radius_m = 0.1, .size_m = {2, 2}, .bottom_m = 0.1});
  text.sun =
      "[{ name = \"noon\", zenith_deg = 20, azimuth_deg = 180, irradiance = 3.0 }, { name = \"evening\", "
      "zenith_deg = 70, azimuth_deg = 270, irradiance = 1.0 }]";
  text.sensor = views("[[0, 0], [30, 90], [50, 200]]");
  text.wavelengths_nm = "[650, 850]";
  text.sampling = "samples = 256";
  const Simulation simulation = simulation_of(folder_, text);
  const Result result = write(simulation);
  EXPECT_EQ(shape_of("brf_by_sun"),
            "('view', 'band', 'sun') (3, 2, 2) ['sun', 'sun_azimuth', 'sun_zenith', 'vaa', 'vza', "
            "'wavelength'] 1 1 True\n");
  EXPECT_EQ(shape_of("radiance_by_sun").substr(0, 34), "('view', 'band', 'sun') (3, 2, 2) ");
  EXPECT_EQ(
      said("d.radiance_by_sun.units, list(d.sun.values), d.sun_zenith.units, d.sun_azimuth.dims, "
           "d.fraction_sunlit.dims, sorted(d.material.values), d.bidirectional_gap.dims, d.overlap.dims, "
           "d.effective_gamma.dims, d.sun_gap.dims, d.sun_effective_g.dims"),
      "W m-2 sr-1 um-1 ['noon', 'evening'] degree ('sun',) ('view', 'sun', 'material') ['leaf', "
      "'soil'] ('view', 'sun') ('view', 'sun') ('view', 'sun', 'band') ('sun',) ('sun',)\n");
  // By label, in any order: the evening's light at the second view in the last band.
  std::size_t evening = 0;
  while (result.sensors[0].parts[evening].sun != 1 ||
         result.sensors[0].parts[evening].component != Component::all ||
         result.sensors[0].parts[evening].order != every_order)
    ++evening;
  EXPECT_THAT(
      numbers("[d.radiance_by_sun.sel(sun=\"evening\").isel(view=1, band=1), "
              "d.radiance_by_sun.sel(sun=\"evening\").sun_zenith, d.radiance_by_sun.sum(\"sun\")[1, 1] - "
              "d.radiance[1, 1]]"),
      ::testing::ElementsAre(::testing::DoubleNear(result.sensors[0].radiance[evening].value[3], 1e-12), 70,
                             ::testing::DoubleNear(0, 1e-6)));
  EXPECT_EQ(without_units(), "[]\n");
}

// Bands of a sensor go by name, and have a wavelength each.
TEST_F(NetcdfInXarray, NamesTheBandsOfASensor) {
  folder_.write("s.tsv",
                "Wavelength\tred\tnir\n600\t0\t0\n640\t1\t0\n680\t1\t0\n720\t0\t0.5\n760\t0\t1\n800\t0\t0.5\n"
                "840\t0\t0\n");
  SceneText text = three_views;
  text.wavelengths_nm.clear();
  text.bands = "response = \"s.tsv\"";
  text.sky = white_sky;
  const Simulation simulation = simulation_of(folder_, text);
  const Result result = write(simulation);
  EXPECT_EQ(shape_of("hdrf"), "('view', 'band') (3, 2) ['band', 'vaa', 'vza', 'wavelength'] 1 1 True\n");
  EXPECT_EQ(shape_of("hdrf_by_origin"),
            "('view', 'band', 'origin') (3, 2, 3) ['band', 'origin', 'vaa', 'vza', 'wavelength'] 1 1 True\n");
  EXPECT_EQ(said("list(d.band.values), list(d.origin.values), d.wavelength.units, "
                 "[round(float(v), 6) for v in d.wavelength]"),
            "['red', 'nir'] ['total', 'direct', 'diffuse'] nm [660.0, 760.0]\n");
  // 0.1 + 0.2 (nm - 400) / 500 is linear: a band's value is that of its mean wavelength.
  EXPECT_THAT(numbers("d.hdrf_by_origin.sel(band=\"nir\", origin=\"direct\")"),
              ::testing::ElementsAre(::testing::DoubleNear(0.244, 1e-6), ::testing::DoubleNear(0.244, 1e-6),
                                     ::testing::DoubleNear(0.244, 1e-6)));
  EXPECT_EQ(result.sensors[0].radiance[0].value.size(), 6u);
  EXPECT_EQ(without_units(), "[]\n");
}

// Irradiance and radiance say their units, the reflectance of each its own name.
TEST_F(NetcdfInXarray, HoldsReceivers) {
  SceneText text = canopy_text(folder_, {.lai = 1, .radius_m = 0.1, .size_m = {2, 2}, .bottom_m = 0.1});
  text.sun = sun_at(30, 90, "2.0");
  text.sensor =
      "name = \"above\"\ntype = \"albedo\"\n"
      "[[sensors]]\nname = \"under it\"\ntype = \"albedo\"\nlooking = \"up\"\nheight_m = 0.01\n"
      "[[sensors]]\nname = \"spot\"\ntype = \"radiometer\"\nlocation = [0, 0, 4]\ndirection = [0, 0, "
      "-1]\nfov_deg = 25\n"
      "[[sensors]]\nname = \"plate\"\ntype = \"radiometer\"\nlocation = [0, 0, 4]\ndirection = [0, 0, "
      "-1]\ncosine = true\n";
  text.wavelengths_nm = "[650, 850]";
  text.sampling = "samples = 256";
  const Simulation simulation = simulation_of(folder_, text);
  const Result result = write(simulation);
  const auto about = [&](const std::string& name) {
    return said(
        fmt::format("d.{0}.dims, d.{0}.shape, d.{0}.units, d.{0}_se.units, \"wavelength\" in "
                    "d.{0}.coords",
                    name));
  };
  EXPECT_EQ(about("above_dhr"), "('above_view', 'band') (1, 2) 1 1 True\n");
  EXPECT_EQ(about("above_irradiance"), "('above_view', 'band') (1, 2) W m-2 um-1 W m-2 um-1 True\n");
  EXPECT_EQ(about("under_it_transmittance"), "('under_it_view', 'band') (1, 2) 1 1 True\n");
  EXPECT_EQ(about("spot_brf"), "('spot_view', 'band') (1, 2) 1 1 True\n");
  EXPECT_EQ(about("spot_radiance"), "('spot_view', 'band') (1, 2) W m-2 sr-1 um-1 W m-2 sr-1 um-1 True\n");
  EXPECT_EQ(about("plate_irradiance"), "('plate_view', 'band') (1, 2) W m-2 um-1 W m-2 um-1 True\n");
  // The sun gives 2 cos 30 on the horizontal.
  EXPECT_THAT(numbers("[d.above_irradiance[0, 1] / d.above_dhr[0, 1], d.above_irradiance[0, 1]]"),
              ::testing::ElementsAre(
                  ::testing::DoubleNear(std::sqrt(3.0), 1e-9),
                  ::testing::DoubleNear(result.sensors[0].radiance[0].value[1] * 3.14159265358979, 1e-9)));
  EXPECT_EQ(without_units(), "[]\n");
}

// Fluxes by their origins, which are fractions of what enters from each.
TEST_F(NetcdfInXarray, HoldsFluxesByOrigin) {
  SceneText text = canopy_text(folder_, {.lai = 1, .radius_m = 0.1, .size_m = {2, 2}, .bottom_m = 0.1});
  text.sun = sun_at(30, 90);
  text.sky = "{ type = \"isotropic\", radiance = 0.5 }";
  text.sensor = "name = \"fluxes\"\ntype = \"flux\"\nlayers = 2\nmap_px = [3, 2]\n";
  text.wavelengths_nm = "[650, 850]";
  text.sampling = "samples = 1024";
  write(simulation_of(folder_, text));
  EXPECT_EQ(said("d.transmitted.dims, d.transmitted_direct.dims, d.transmitted_by_origin.dims, "
                 "d.transmitted_direct_by_origin.shape, sorted(d.transmitted_by_origin.coords), "
                 "d.absorbed_layer_by_origin.dims, d.absorbed_layer_by_origin.shape, d.absorbed_layer.units, "
                 "d.ground_irradiance.shape"),
            "('band',) ('band',) ('band', 'origin') (2, 3) ['origin', 'wavelength'] ('layer', 'band', "
            "'origin') (2, 2, 3) 1 (2, 3, 2)\n");
  // The sky gives 0.5 pi beside the sun's pi. What the sun sends straight down is its own, and no more than
  // all of its light that arrives.
  EXPECT_THAT(numbers("[(d.reflected_by_origin.sel(origin=\"direct\") + 0.5 * "
                      "d.reflected_by_origin.sel(origin=\"diffuse\"))[0] / 1.5 - d.reflected[0], "
                      "d.transmitted_by_origin.sel(origin=\"total\")[1] - d.transmitted[1]]"),
              ::testing::Each(::testing::AllOf(::testing::Ge(-1e-12), ::testing::Le(1e-12))));
  EXPECT_THAT(numbers("(d.transmitted_by_origin - d.transmitted_direct_by_origin).values.ravel()"),
              ::testing::Each(::testing::Gt(0)));
  EXPECT_EQ(without_units(), "[]\n");
}

// Views that share paths have a covariance, symmetric, whose diagonal is the square of the standard errors.
TEST_F(NetcdfInXarray, HoldsTheCovarianceOfViews) {
  SceneText text = canopy_text(folder_, {.lai = 2, .radius_m = 0.1, .size_m = {2, 2}, .bottom_m = 0.1});
  text.sun = sun_at(30, 90);
  text.sensor = views("[[0, 0], [10, 90], [20, 90], [30, 270], [50, 0]]");
  text.wavelengths_nm = "[650, 850]";
  text.sampling = "samples = 1024\nmode = \"forward\"";
  const Simulation simulation = simulation_of(folder_, text);
  const Result result = write(simulation);
  ASSERT_EQ(result.sensors[0].covariance.size(), 2u * 5 * 5);
  EXPECT_EQ(said("d.covariance.dims, d.covariance.shape, d.covariance.units, \"wavelength\" in "
                 "d.covariance.coords"),
            "('band', 'view', 'view_other') (2, 5, 5) (W m-2 sr-1 um-1)2 True\n");
  EXPECT_THAT(numbers("[abs(d.covariance[b, v, v] ** 0.5 / d.radiance_se[v, b] - 1) for b in range(2) for v "
                      "in range(5)]"),
              ::testing::Each(::testing::Le(1e-9)));
  EXPECT_THAT(numbers("[d.covariance[1, 0, 1] - d.covariance[1, 1, 0], d.covariance[1, 0, 1] - " +
                      fmt::format("{:.17g}]", result.sensors[0].covariance[25 + 1])),
              ::testing::Each(0.0));
  EXPECT_EQ(without_units(), "[]\n");
}

}  // namespace
}  // namespace bpms::test
