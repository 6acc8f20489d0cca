// bpms recolour by hand: a result of many bands under other spectra, and what it cannot work with.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "core/csv.h"
#include "tests/apps/refused.h"
#include "tests/command.h"

namespace bpms::test {
namespace {

using ::testing::HasSubstr;

// 25 bands, under sun and sky.
const Edit many_bands =
    both(replaced("scene.toml", "wavelengths_nm = [650.0]",
                  "wavelengths_nm = { from = 400, to = 1000, step = 25 }"),
         replaced("scene.toml", "irradiance = \"brf\" }",
                  "irradiance = 1000.0 }\nsky = { type = \"isotropic\", irradiance = 150.0 }"));
const std::string other_leaf =
    "type = \"bilambertian\"\nreflectance = [[400, 0.1], [1000, 0.5]]\ntransmittance = 0.2\n";
const std::string other_soil = "type = \"lambertian\"\nreflectance = [[400, 0.3], [1000, 0.35]]\n";
const std::string other = "[materials.leaf]\n" + other_leaf + "[materials.soil]\n" + other_soil;
const std::string recolour = "recolour kept.nc --materials other.toml -o new.nc --csv new.csv";

std::vector<double> reflectances(const std::string& csv, const std::string& column) {
  const CsvTable table = CsvTable::parse("new.csv", csv);
  std::vector<double> out;
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (table.text(row, table.require("quantity")) == "hdrf" &&
        table.text(row, table.require("origin")) == "total" &&
        table.text(row, table.require("component")) == "all" &&
        table.text(row, table.require("order")).empty())
      out.push_back(table.number(row, table.require(column)));
  return out;
}

TEST(Recolour, ManyBandsAreThoseOfARunWithTheseSpectra) {
  const SoundFolder folder;
  many_bands(folder);
  folder.write("other.toml", other);
  Outcome run = run_bpms(folder, "simulate scene.toml -o kept.nc --keep-interactions --samples 16384");
  ASSERT_EQ(run.code, 0) << run.error;
  run = run_bpms(folder, recolour + " --derivatives by.csv --report new.html");
  ASSERT_EQ(run.code, 0) << run.error;
  replaced("scene.toml", "type = \"bilambertian\"\nreflectance = 0.4\ntransmittance = 0.3\n",
           other_leaf)(folder);
  replaced("scene.toml", "type = \"lambertian\"\nreflectance = \"soil.csv\"\n", other_soil)(folder);
  run = run_bpms(folder, "simulate scene.toml -o own.nc --csv own.csv --samples 16384 --seed 2");
  ASSERT_EQ(run.code, 0) << run.error;
  const std::vector<double> value = reflectances(read_file(folder / "new.csv"), "value"),
                            error = reflectances(read_file(folder / "new.csv"), "standard_error"),
                            own = reflectances(read_file(folder / "own.csv"), "value"),
                            own_error = reflectances(read_file(folder / "own.csv"), "standard_error");
  ASSERT_EQ(value.size(), 25u);
  ASSERT_EQ(own.size(), 25u);
  for (std::size_t band = 0; band < 25; ++band) {
    EXPECT_LT(std::abs(value[band] - own[band]), 4 * std::hypot(error[band], own_error[band])) << band;
    EXPECT_LT(error[band], 0.05 * value[band]) << band;
  }
  const CsvTable by = CsvTable::parse("by.csv", read_file(folder / "by.csv"));
  EXPECT_EQ(by.rows(), 25u * 6);  // bands x spectra: two reflectances and a transmittance of each material
  EXPECT_GT(read_file(folder / "new.html").size(), 10000u);
}

// A result to work on, made once.
const std::string& kept() {
  static const std::string bytes = [] {
    const SoundFolder folder;
    many_bands(folder);
    const Outcome run = run_bpms(folder, "simulate scene.toml -o kept.nc --keep-interactions");
    EXPECT_EQ(run.code, 0) << run.error;
    return read_file(folder / "kept.nc");
  }();
  return bytes;
}
Refusal row(const std::string& name, const std::string& materials, const std::string& begin,
            const std::vector<std::string>& holds, int code = 2) {
  const Edit edit = [materials](const TemporaryFolder& folder) {
    folder.write("kept.nc", kept());
    folder.write("other.toml", materials);
  };
  return {name, edit, recolour, code, begin, holds};
}
Refusal result(const std::string& name, const Edit& edit, const std::string& begin,
               const std::vector<std::string>& holds, int code = 2) {
  return {name, both(written("other.toml", other), edit), recolour, code, begin, holds};
}
const Edit without_histograms = [](const TemporaryFolder& folder) {
  many_bands(folder);
  const Outcome run = run_bpms(folder, "simulate scene.toml -o kept.nc");
  ASSERT_EQ(run.code, 0) << run.error;
};
const Edit cut_short = [](const TemporaryFolder& folder) {
  folder.write("kept.nc", kept().substr(0, kept().size() / 2));
};

INSTANTIATE_TEST_SUITE_P(
    Recolour, Refused,
    ::testing::ValuesIn(std::vector<Refusal>{
        result("NoResult", as_it_is(), "kept.nc: no such file", {}, 3),
        result("AFolder", a_folder_instead("kept.nc"), "kept.nc: is a folder", {}, 3),
        result("AnEmptyFile", written("kept.nc", ""), "kept.nc: the file is empty", {}),
        result("ATextFile", written("kept.nc", "quantity,value\nbrf,1\n"), "kept.nc: ", {"NetCDF"}),
        result("CutShort", cut_short, "kept.nc: ", {}),
        result("WithoutHistograms", without_histograms, "kept.nc: ", {"--keep-interactions"}),
        Refusal{"NoMaterialsGiven", as_it_is(), "recolour kept.nc -o new.nc", 2, "", {"--materials"}},
        row("UnknownMaterial", other + "[materials.bark]\n" + other_soil, "other.toml:", {"'bark'"}),
        row("MaterialsThatDoNotCover",
            "[materials.soil]\ntype = \"lambertian\"\nreflectance = [[400, 0.3], [900, 0.35]]\n",
            "other.toml:3:15: ", {"400 to 900 nm", "925 nm"}),
        row("OtherBandsThanTheLightHas", other + "[bands]\nwavelengths_nm = [350, 500]\n",
            "other.toml:", {"350"}),
        row("OtherBandsWithoutAMaterial",
            "[materials.soil]\n" + other_soil + "[bands]\nwavelengths_nm = [500]\n",
            "other.toml:", {"[materials.leaf]"}),
        row("NoMaterials", "[bands]\nwavelengths_nm = [500]\n", "other.toml:", {"materials"}),
        row("MaterialsAboveOne", "[materials.soil]\ntype = \"lambertian\"\nreflectance = 40\n",
            "other.toml:3:15: ", {"from 0 to 1"}),
        row("AnUnknownKey", other + "[sampling]\nsamples = 64\n", "other.toml:", {"'sampling'"}),
        row("AWayThatWasNotTraced",
            "[materials.soil]\ntype = \"bilambertian\"\nreflectance = 0.3\ntransmittance = 0.2\n", "",
            {"soil.transmittance", "was 0 when the paths were traced"})}),
    name_of_case);

}  // namespace
}  // namespace bpms::test
