#include "tests/materials/materials_of.h"

namespace bpms::test {

Materials materials_of(const TemporaryFolder& folder, const std::string& text,
                       const std::vector<double>& wavelengths_nm) {
  Materials out;
  out.bands.wavelengths_nm = wavelengths_nm;
  const TomlDocument document = TomlDocument::parse(folder / "scene.toml", text);
  const TomlValue materials = document.root().require("materials");
  MaterialContext context(materials, out.bands, out.inputs);
  for (const std::string& name : materials.keys())
    out.by_name[name] = context.material(name, materials.require(name));
  document.finish();
  return out;
}

Material material_of(const TemporaryFolder& folder, const std::string& body,
                     const std::vector<double>& wavelengths_nm) {
  return materials_of(folder, "[materials.x]\n" + body + "\n", wavelengths_nm)["x"];
}

Material material_of(const std::string& body, const std::vector<double>& wavelengths_nm) {
  return material_of(TemporaryFolder(), body, wavelengths_nm);
}

std::vector<double> values_of(const SurfaceLobe& lobe, const Eigen::Vector3f& view,
                              const Eigen::Vector3f& light, std::size_t bands) {
  std::vector<double> out(bands);
  if (lobe.lobe->separable()) {
    for (std::size_t band = 0; band < bands; ++band)
      out[band] = lobe.spectrum[band] * static_cast<double>(lobe.lobe->shape(view, light));
    return out;
  }
  std::vector<float> values(bands);
  lobe.lobe->values(view, light, values);
  out.assign(values.begin(), values.end());
  return out;
}

}  // namespace bpms::test
