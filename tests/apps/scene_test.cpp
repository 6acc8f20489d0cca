// scene.toml and the files it names: spectra, discs, positions, meshes.
#include "tests/apps/refused.h"

namespace bpms::test {
namespace {

Refusal row(const std::string& name, const std::string& what, const std::string& by, const std::string& begin,
            const std::vector<std::string>& holds = {}) {
  return {name, replaced("scene.toml", what, by), simulate, 2, "scene.toml:" + begin, holds};
}
Refusal planted(const std::string& name, const std::string& what, const std::string& by,
                const std::string& begin, const std::vector<std::string>& holds = {}) {
  return {
      name, replaced("planted.toml", what, by), "simulate planted.toml -o new.nc", 2, "planted.toml:" + begin,
      holds};
}
Refusal file(const std::string& name, const std::string& which, const std::string& content,
             const std::string& begin, const std::vector<std::string>& holds = {}) {
  return {name, written(which, content), simulate, 2, begin, holds};
}

INSTANTIATE_TEST_SUITE_P(
    Scene, Refused,
    ::testing::ValuesIn(std::vector<Refusal>{
        Refusal{"Truncated", cut_behind("scene.toml", "views = [[0.0"), simulate, 2, "scene.toml:25:", {}},
        Refusal{"TruncatedBetweenTables",
                cut_behind("scene.toml", "positions = \"places.def\"\n"),
                simulate,
                2,
                "scene.toml",
                {}},
        row("ReflectanceAndTransmittanceAboveOne", "reflectance = 0.4", "reflectance = 0.8",
            "6:15: ", {"reflectance 0.8", "transmittance 0.3", "at most 1"}),
        row("ReflectanceAboveOne", "reflectance = 0.4", "reflectance = 40", "6:15: ", {"from 0 to 1"}),
        row("NegativeTransmittance", "transmittance = 0.3", "transmittance = -0.3",
            "7:17: ", {"transmittance", "from 0 to 1"}),
        row("ReflectanceNotANumber", "reflectance = 0.4", "reflectance = nan",
            "6:15: ", {"reflectance", "finite"}),
        row("ReflectanceAsText", "reflectance = 0.4", "reflectance = true", "6:15: ", {"expected a number"}),
        row("SunAtTheHorizon", "zenith_deg = 30.0", "zenith_deg = 90.0",
            "21:22: ", {"sun.zenith_deg is 90", "above the horizon"}),
        row("SunBelowTheHorizon", "zenith_deg = 30.0", "zenith_deg = 120",
            "21:22: ", {"sun.zenith_deg is 120", "above the horizon"}),
        row("SunOfNegativeZenith", "zenith_deg = 30.0", "zenith_deg = -1",
            "21:22: ", {"sun.zenith_deg is -1"}),
        row("SunNotANumber", "zenith_deg = 30.0", "zenith_deg = nan",
            "21:22: ", {"sun.zenith_deg", "finite"}),
        row("SunInRadians", "zenith_deg", "zenith", "21:9: ", {"unknown key 'zenith'", "zenith_deg"}),
        row("HugeAzimuth", "azimuth_deg = 0.0", "azimuth_deg = 1e9",
            "21:42: ", {"azimuth_deg", "from -360 to 360"}),
        row("NegativeIrradiance", "irradiance = \"brf\"", "irradiance = -1", "21:60: ", {"irradiance"}),
        row("NoLight", "sun = { zenith_deg = 30.0, azimuth_deg = 0.0, irradiance = \"brf\" }", "",
            "20:1: ", {"no light"}),
        row("UnknownMaterial", "material = \"soil\"", "material = \"siol\"",
            "13:12: ", {"[materials.siol]", "did you mean 'soil'?"}),
        row("UnknownMaterialType", "\"bilambertian\"", "\"bilambertain\"",
            "5:8: ", {"did you mean 'bilambertian'?"}),
        row("UnknownKey", "transmittance", "transmitance",
            "7:1: ", {"'transmitance'", "did you mean 'transmittance'?"}),
        row("UnknownTable", "[illumination]", "[ilumination]",
            "20:2: ", {"'ilumination'", "did you mean 'illumination'?"}),
        row("UnknownPrototype", "prototype = \"crown\"", "prototype = \"crwn\"",
            "18:13: ", {"[prototypes.crwn]", "did you mean 'crown'?"}),
        row("UnknownSensorType", "\"brf\"\nviews", "\"brff\"\nviews", "24:8: ", {"did you mean 'brf'?"}),
        row("SensorOfLater", "\"brf\"\nviews", "\"lidar\"\nviews", "24:8: ", {"not built yet"}),
        row("MisspeltSamples", "samples = 64", "sampels = 64",
            "29:1: ", {"'sampels'", "did you mean 'samples'?"}),
        row("MisspeltTarget", "samples = 64", "target_es = 0.1",
            "29:1: ", {"'target_es'", "did you mean 'target_se'?"}),
        row("OnlyMaxSamples", "samples = 64", "max_samples = 64", "28:1: ", {"one of target_se and samples"}),
        row("BothStops", "samples = 64", "samples = 64\ntarget_se = 0.1",
            "28:1: ", {"one of target_se and samples"}),
        row("NoSamples", "samples = 64", "samples = 0", "29:11: ", {"samples"}),
        row("PartOfASample", "samples = 64", "samples = 6.5", "29:11: ", {"whole number"}),
        row("HugeSamples", "samples = 64", "samples = 1e300", "29:11: ", {"samples"}),
        row("ZeroTarget", "samples = 64", "target_se = 0", "29:13: ", {"above 0"}),
        row("ZeroDomain", "[1.0, 1.0]", "[0, 1.0]", "2:10: ", {"size_m", "above 0"}),
        row("NegativeDomain", "[1.0, 1.0]", "[1.0, -1.0]", "2:10: ", {"size_m", "above 0"}),
        row("HugeDomain", "[1.0, 1.0]", "[1e9, 1e9]", "2:10: ", {"1e7 m"}),
        row("NoDomain", "size_m = [1.0, 1.0]\n", "", "1:1: ", {"size_m = [x, y]"}),
        row("UnknownBoundary", "\"periodic\"", "\"periodical\"", "3:12: ", {"did you mean 'periodic'?"}),
        row("GroundNotANumber", "type = \"plane\"", "type = \"plane\"\nheight_m = nan",
            "13:12: ", {"height_m"}),
        row("NoDiscMaterial", "material = \"leaf\"\n", "", "14:1: ", {"[prototypes.crown] needs material"}),
        row("TwoKindsOfPrototype", "material = \"leaf\"", "plant = \"grass.bpms\"\nmaterial = \"leaf\"",
            "14:1: ", {"one of discs, plant, mesh"}),
        row("NegativeScale", "prototype = \"crown\"", "prototype = \"crown\"\nscale = -1",
            "19:9: ", {"scale", "above 0"}),
        row("HugeScale", "prototype = \"crown\"", "prototype = \"crown\"\nscale = 1e14", "19:9: ", {"scale"}),
        row("SteepView", "[[0.0, 0.0]]", "[[90.0, 0.0]]", "25:11: ", {"90", "at most 89"}),
        row("OneAngle", "[[0.0, 0.0]]", "[[0.0]]", "25:10: ", {"expected 2"}),
        row("NoViews", "[[0.0, 0.0]]", "[]", "25:9: ", {"at least one"}),
        row("TooManyViews", "views = [[0.0, 0.0]]",
            "plane = \"principal\"\nvza_deg = { from = 0, to = 80, step = 1e-9 }", "26:", {"step"}),
        row("TwoSensorsOfOneName", "[bands]",
            "[[sensors]]\nname = \"nadir\"\ntype = \"brf\"\nviews = [[1, 0]]\n[bands]",
            "27:8: ", {"\"nadir\""}),
        row("WavelengthInMicrometres", "650.0", "0.65", "27:19: ", {"wavelengths_nm", "0.65"}),
        row("NegativeWavelength", "650.0", "-650", "27:19: ", {"wavelengths_nm"}),
        row("WavelengthBeyondTheSpectrum", "650.0", "1500", "10:15: ", {"400 to 1000 nm", "1500 nm"}),
        row("SpectrumWithoutBands", "[bands]\nwavelengths_nm = [650.0]\n", "", "10:15: ", {"needs [bands]"}),
        row("KeyTwice", "samples = 64", "samples = 64\nsamples = 32", "30:", {"samples"}),
        row("OpenBracket", "[650.0]", "[650.0", "2", {}),
        row("DecimalComma", "reflectance = 0.4", "reflectance = 0,4", "6:", {}),
        row("NestedWithoutEnd", "[650.0]", std::string(5000, '['), "27", {"nested"}),
        Refusal{"AbsentDiscs",
                replaced("scene.toml", "crown.def", "crwn.def"),
                simulate,
                3,
                "crwn.def: no such file",
                {}},
        Refusal{"AbsentSpectrum",
                replaced("scene.toml", "soil.csv", "siol.csv"),
                simulate,
                3,
                "siol.csv: no such file",
                {}},
        Refusal{"NoSamplesOnTheCommandLine", as_it_is(), simulate + " --samples 0", 2, "", {"--samples"}},
        Refusal{"BadTargetOnTheCommandLine",
                as_it_is(),
                simulate + " --target-se -1",
                2,
                "",
                {"--target-se", "above 0"}},
        Refusal{
            "NothingToDescribe",
            replaced("scene.toml", "[[instances]]\nprototype = \"crown\"\npositions = \"places.def\"", ""),
            "describe scene.toml",
            2,
            "scene.toml",
            {"no structure to describe"}}}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    PlantedScene, Refused,
    ::testing::ValuesIn(std::vector<Refusal>{
        planted("UnknownCanopyKey",
                "canopy = ", "canopi = ", "1:1: ", {"'canopi'", "did you mean 'canopy'?"}),
        planted("MaterialOfAPlantUnknown", "stem = { type = \"lambertian\", reflectance = 0.2 }", "",
                "1:10: ", {"[materials.stem]"}),
        planted("ImageWithoutColumns", "width_px = 4", "width_px = 0", "14:12: ", {"width_px"}),
        planted("HugeImage", "width_px = 4", "width_px = 1e9", "14:12: ", {"width_px"}),
        planted("FieldOfAHalfTurn", "fov_deg = 20", "fov_deg = 180", "13:11: ", {"fov_deg"}),
        planted("LooksAtItself", "look_at = [0, 0, 0]", "look_at = [0, 0, 3]",
                "12:11: ", {"away from the sensor"}),
        planted("LocationNotANumber", "location = [0, 0, 3]", "location = [0, nan, 3]",
                "11:16: ", {"location", "finite"}),
        planted("FarAway", "location = [0, 0, 3]", "location = [0, 0, 1e14]", "11:12: ", {"location"}),
        planted("SkyOfBothUnits", "radiance = 1.0", "radiance = 1.0, irradiance = 1.0",
                "7:", {"one of radiance and irradiance"}),
        planted("UnknownSky", "\"isotropic\"", "\"isotropical\"", "7:16: ", {"did you mean 'isotropic'?"})}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    Discs, Refused,
    ::testing::ValuesIn(std::vector<Refusal>{
        file("Truncated", "crown.def", "0.05 0 0 0.5 0 0 1\n0.05 0.2 0 0",
             "crown.def:2: ", {"4 columns, expected 7"}),
        file("TooManyColumns", "crown.def", "0.05 0 0 0.5 0 0 1 9\n", "crown.def:1:20: ", {"more than 7"}),
        file("ZeroRadius", "crown.def", "0 0 0 0.5 0 0 1\n", "crown.def:1:1: ", {"radius 0", "above 0"}),
        file("NegativeRadius", "crown.def", "-1 0 0 0.5 0 0 1\n",
             "crown.def:1:1: ", {"radius -1", "above 0"}),
        file("NotANumber", "crown.def", "0.05 0 nan 0.5 0 0 1\n", "crown.def:1:8: ", {"'nan'", "expected y"}),
        file("HugeNumber", "crown.def", "0.05 0 0 1e30 0 0 1\n", "crown.def:1:10: ", {"'1e30'", "below 1e7"}),
        file("TinyRadius", "crown.def", "1e-60 0 0 0.5 0 0 1\n", "crown.def:1:1: ", {"radius"}),
        file("NoNormal", "crown.def", "0.05 0 0 0.5 0 0 0\n", "crown.def:1:1: ", {"normal is (0, 0, 0)"}),
        file("OnlyComments", "crown.def", "# radius x y z\n", "crown.def: ", {"no rows"}),
        file("Commas", "crown.def", "0.05,0,0,0.5,0,0,1\n", "crown.def:1:1: ", {"expected radius"})}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    Positions, Refused,
    ::testing::ValuesIn(std::vector<Refusal>{
        file("Truncated", "places.def", "0 0 0\n0.3 0", "places.def:2: ", {"2 columns, expected 3 to 6"}),
        file("NotANumber", "places.def", "0 0 0\n0.3 nan 0\n", "places.def:2:5: ", {"'nan'", "finite"}),
        file("HugeNumber", "places.def", "0 0 1e9\n", "places.def:1: ", {"1e7 m"}),
        file("Letters", "places.def", "0 0 zero\n", "places.def:1:5: ", {"'zero'"})}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    Spectrum, Refused,
    ::testing::ValuesIn(std::vector<Refusal>{
        file("Truncated", "soil.csv", "nm,reflectance\n400,0.1\n700,",
             "soil.csv:3:", {"wavelength in nm and a value"}),
        file("OnlyAHeader", "soil.csv", "nm,reflectance\n", "soil.csv: ", {"no rows"}),
        file("NotANumber", "soil.csv", "400,0.1\n700,nan\n", "soil.csv:2:5: ", {"'700 nan'"}),
        file("Descending", "soil.csv", "700,0.1\n400,0.2\n",
             "soil.csv:2:", {"400 nm does not come after 700 nm"}),
        file("InPercent", "soil.csv", "400,10\n700,20\n", "", {"from 0 to 1"}),
        file("InMicrometres", "soil.csv", "0.4,0.1\n0.7,0.2\n", "", {"0.4 to 0.7", "micrometres"}),
        file("Negative", "soil.csv", "400,0.1\n700,-0.2\n", "", {"from 0 to 1"}),
        file("HugeNumber", "soil.csv", "400,0.1\n700,1e300\n", "", {"from 0 to 1"})}),
    name_of_case);

const std::string with_mesh = "mesh = \"leaf.obj\"\nunit = \"cm\"";
Edit mesh(const std::string& prototype, const std::string& content) {
  return both(replaced("scene.toml", "discs = \"crown.def\"", prototype), written("leaf.obj", content));
}
INSTANTIATE_TEST_SUITE_P(
    MeshFile, Refused,
    ::testing::ValuesIn(std::vector<Refusal>{
        Refusal{"Empty", mesh(with_mesh, ""), simulate, 2, "leaf.obj: ", {}},
        Refusal{"Noise", mesh(with_mesh, "\x01\x80 \xff"), simulate, 2, "leaf.obj: ", {}},
        Refusal{"NotANumber",
                mesh(with_mesh, "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
                simulate,
                2,
                "leaf.obj: ",
                {"not finite"}},
        Refusal{"HugeNumber",
                mesh(with_mesh, "v 0 0 1e30\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
                simulate,
                2,
                "leaf.obj: ",
                {"vertex"}},
        Refusal{"NoTriangles", mesh(with_mesh, "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), simulate, 2, "leaf.obj: ", {}},
        Refusal{"IndexOutOfRange",
                mesh(with_mesh, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"),
                simulate,
                2,
                "leaf.obj:4:7: ",
                {"number 9 of the vertices"}},
        Refusal{"WrongUnit",
                mesh("mesh = \"leaf.obj\"\nunit = \"foot\"", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
                simulate,
                2,
                "scene.toml:16:8: ",
                {"'foot'", "known: m, cm"}},
        Refusal{"Absent", mesh("mesh = \"laef.obj\"", "x"), simulate, 3, "laef.obj: no such file", {}}}),
    name_of_case);

}  // namespace
}  // namespace bpms::test
