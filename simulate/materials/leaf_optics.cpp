#include "simulate/materials/leaf_optics.h"

#include <fmt/format.h>

#include <cmath>

#include "simulate/materials/material.h"

namespace bpms {

SceneOptics read_leaf_optics(const std::string& scene_file, const std::vector<std::string>& materials) {
  SceneOptics out;
  const TomlDocument document = TomlDocument::read(scene_file);
  out.inputs.push_back(scene_file);
  const Bands bands = read_bands(document.root().get("bands"), out.inputs);
  const TomlValue table = document.root().get("materials");
  if (!table) bad_input({scene_file}, "there is no [materials]");
  MaterialContext context(table, bands, out.inputs);
  out.bands.resize(bands.written());
  for (std::size_t b = 0; b < out.bands.size(); ++b) {
    out.bands[b].name = bands.written_name(b);
    if (out.bands[b].name.empty() && std::isfinite(bands.written_nm(b)))
      out.bands[b].name = fmt::format("{:g} nm", bands.written_nm(b));
  }
  for (const std::string& name : materials) {
    if (!context.has(name))
      bad_input(table.where(), "there is no [materials.{}], and leaves are of that material", name);
    const Material& material = context.material(name, table);
    if (!material.is_diffuse())
      out.notes.push_back(
          fmt::format("{}: of material {} only the diffuse part is in Gamma", scene_file, in_quotes(name)));
    const std::vector<double> front = bands.integrate(material.reflectance[0]),
                              back = bands.integrate(material.reflectance[1]),
                              through = bands.integrate(material.transmittance);
    for (std::size_t b = 0; b < out.bands.size(); ++b)
      out.bands[b].of_material[name] = {0.5 * (front[b] + back[b]), through[b]};
  }
  return out;
}

}  // namespace bpms
