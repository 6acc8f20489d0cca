#include "bench/homogeneous_scene.h"

#include "core/text.h"
#include "core/units.h"

namespace bpms::bench {

Simulation homogeneous(const std::string& data_folder, const std::vector<double>& vza_deg) {
  Simulation out;
  Scene& scene = out.scene;
  scene.domain.size_m = {25, 25};
  scene.domain.azimuth_north_clockwise = false;
  scene.materials = {"leaf", "soil"};
  Prototype canopy;
  canopy.name = "canopy";
  const NumberTable table =
      read_number_table(data_folder + "/bench_hom/hom_discs.def.gz", 7, 7, "radius x y z nx ny nz");
  for (const auto& row : table.rows) {
    const Eigen::Vector3d normal = Eigen::Vector3d(row[4], row[5], row[6]).normalized();
    canopy.discs.push_back({Eigen::Vector3d(row[1], row[2], row[3]).cast<float>(), static_cast<float>(row[0]),
                            normal.cast<float>()});
  }
  scene.prototypes.push_back(std::move(canopy));
  scene.instances.emplace_back();
  scene.ground = Ground{0.0, 1};

  out.bands.wavelengths_nm = {650, 850};
  Material leaf, soil;
  leaf.name = "leaf";
  leaf.opaque = false;
  leaf.reflectance = {{{0.0546, 0.4957}, {0.0546, 0.4957}}};
  leaf.transmittance = {0.0149, 0.4409};
  soil.name = "soil";
  soil.reflectance = {{{0.127, 0.159}, {0.127, 0.159}}};
  soil.transmittance = {0, 0};
  out.materials = {leaf, soil};

  std::string text = "sun = { zenith_deg = 20.0, azimuth_deg = 0.0, irradiance = \"brf\" }\n";
  text += "[sensor]\nname = \"pp\"\ntype = \"brf\"\nplane = \"principal\"\nvza_deg = [";
  for (const double vza : vza_deg) text += fmt::format("{}, ", vza);
  const TomlDocument document = TomlDocument::parse("benchmark", text + "]\n");
  out.light = read_light(document.root(), scene.domain, out.bands, out.inputs, out.scene.notes);
  out.sensors.push_back(
      read_sensor(document.root().get("sensor"), {out.scene, out.light, out.inputs, out.scene.notes}));
  return out;
}

}  // namespace bpms::bench
