// A sky from a NetCDF file is that of the CSV file with the same values.
#include <netcdf.h>

#include "tests/light/light_text.h"

namespace bpms::test {
namespace {

struct SkyFile {
  std::vector<double> zenith{0, 45, 90}, azimuth{0, 90, 180, 270}, wavelength{600, 700};
  std::vector<std::string> order{"zenith", "azimuth", "wavelength"};
  std::string wavelength_unit = "nm";
  double missing_at_zenith = -1;  // a value that is left out

  double radiance(double z, double a, double w) const { return 1 + z / 90 + a / 100 + w / 500; }

  void write(const std::string& path) const {
    const auto values = [&](const std::string& name) {
      return name == "zenith" ? zenith : name == "azimuth" ? azimuth : wavelength;
    };
    int file = 0, variable = 0;
    std::vector<int> dimensions;
    ASSERT_EQ(nc_create(path.c_str(), NC_CLOBBER, &file), NC_NOERR);
    for (const std::string& name : order) {
      int dimension = 0, coordinate = 0;
      nc_def_dim(file, name.c_str(), values(name).size(), &dimension);
      nc_def_var(file, name.c_str(), NC_DOUBLE, 1, &dimension, &coordinate);
      if (name == "wavelength")
        nc_put_att_text(file, coordinate, "units", wavelength_unit.size(), wavelength_unit.c_str());
      dimensions.push_back(dimension);
    }
    nc_def_var(file, "radiance", NC_FLOAT, static_cast<int>(order.size()), dimensions.data(), &variable);
    nc_enddef(file);
    for (const std::string& name : order) {
      int coordinate = 0;
      nc_inq_varid(file, name.c_str(), &coordinate);
      nc_put_var_double(file, coordinate, values(name).data());
    }
    for (std::size_t i = 0; i < zenith.size(); ++i)
      for (std::size_t j = 0; j < azimuth.size(); ++j)
        for (std::size_t k = 0; k < wavelength.size(); ++k) {
          std::vector<std::size_t> at;
          for (const std::string& name : order)
            at.push_back(name == "zenith" ? i : name == "azimuth" ? j : k);
          const double value = radiance(zenith[i], azimuth[j], wavelength[k]);
          if (zenith[i] != missing_at_zenith) nc_put_var1_double(file, variable, at.data(), &value);
        }
    nc_close(file);
  }
};

Light light_of(const TemporaryFolder& folder) {
  LightScene scene;
  scene.bands.wavelengths_nm = {600, 650};
  return scene.read("[sky]\ntype = \"map\"\nfile = \"sky.nc\"\n", folder / "scene.toml");
}

TEST(SkyNetcdf, DimensionsMayComeInAnyOrder) {
  for (const auto& order : {std::vector<std::string>{"zenith", "azimuth", "wavelength"},
                            std::vector<std::string>{"wavelength", "azimuth", "zenith"}}) {
    const TemporaryFolder folder;
    SkyFile sky;
    sky.order = order;
    sky.write(folder / "sky.nc");
    const Light light = light_of(folder);
    std::vector<float> out(2);
    for (const double azimuth_deg : {90.0, 270.0}) {
      light.sky->map->radiance(sky_at(45, azimuth_deg), out);
      EXPECT_NEAR(out[0], sky.radiance(45, azimuth_deg, 600), 1e-5);
      EXPECT_NEAR(out[1], sky.radiance(45, azimuth_deg, 650), 1e-5);
    }
  }
}

TEST(SkyNetcdf, RefusesWhatIsNoSky) {
  const auto refused = [](const SkyFile& sky, const char* message) {
    const TemporaryFolder folder;
    sky.write(folder / "sky.nc");
    BPMS_EXPECT_ERROR(light_of(folder), ErrorKind::bad_input, message);
  };
  SkyFile sky;
  sky.zenith = {0, 40, 90};
  refused(sky, "zenith_deg has 3 values and 40 among them");
  sky = {};
  sky.azimuth = {0, 180, 90, 270};
  refused(sky, "variable azimuth: 90 at 2: expected increasing values");
  sky = {};
  sky.wavelength_unit = "um";
  refused(sky, "variable wavelength is in 'um': expected nm");
  sky = {};
  sky.missing_at_zenith = 45;
  refused(sky, "no radiance at zenith_deg 45, azimuth_deg 0, wavelength_nm 600");
  sky = {};
  sky.order = {"zenith", "wavelength"};
  refused(sky, "expected variables zenith, azimuth and radiance");
  const TemporaryFolder folder;
  BPMS_EXPECT_ERROR(light_of(folder), ErrorKind::missing_resource, "no such file");
  folder.write("sky.nc", "zenith,azimuth\n");
  BPMS_EXPECT_ERROR(light_of(folder), ErrorKind::bad_input, "it cannot be opened");
}

}  // namespace
}  // namespace bpms::test
