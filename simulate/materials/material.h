// Optical properties of surfaces, by name, from [materials.X] of scene.toml: a diffuse part (Lambert's law on
// the side it sends light to: reflectance of each face and one transmittance, per traced band, dimensionless,
// reflectance + transmittance <= 1) and lobes beside it. To add a kind: its own file with a reader, declared
// below, and a line in the table of read_material.cpp.
#pragma once
#include <array>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "simulate/materials/lobe.h"
#include "simulate/materials/raster.h"
#include "simulate/materials/spectrum.h"

namespace bpms {

struct SurfaceLobe {
  std::shared_ptr<const Lobe> lobe;
  std::vector<double> spectrum;             // per traced band; empty where the lobe is not separable
  std::array<bool, 2> on_face{true, true};  // seen from the front, from the back
};

struct Material {
  std::string name;
  std::string type;
  std::array<std::vector<double>, 2> reflectance;  // of the upper (front) and the lower (back) face, per band
  std::vector<double> transmittance;
  bool opaque = true;  // nothing passes: lit means lit on the side that is seen
  std::vector<SurfaceLobe> lobes;

  // A material map: each place (U,V) is of another material. The raster holds indices into map_materials,
  // whose names are not maps themselves.
  std::shared_ptr<const Raster> map;
  std::vector<std::string> map_materials;
  // A bump map: heights over (U,V), which tilt the normal; `bump_m` = metres for a value of 1 of the raster.
  std::shared_ptr<const Raster> bump;
  double bump_m = 0;

  std::vector<std::string> notes;  // what the user should know about it, one line each

  bool is_diffuse() const { return lobes.empty() && !map && !bump; }
};

// What readers of materials share: the bands, the files that were read, and the other materials of the file.
class MaterialContext {
 public:
  // `materials` is [materials] of the scene (or nothing); all three must outlive the context.
  MaterialContext(const TomlValue& materials, const Bands& bands, std::vector<std::string>& inputs)
      : table_(materials), bands_(bands), inputs_(inputs) {}

  const Bands& bands() const { return bands_; }
  std::vector<double> spectrum(const TomlValue& value, double low, double high) const {
    return read_spectrum(value, bands_, low, high, inputs_);
  }
  // The path of a file that the scene names, kept as an input.
  std::string input_file(const TomlValue& value) const;
  bool has(const std::string& name) const;
  // Reads it when it is first asked for. Refused at `asked`: a name without a table, a material that is made
  // of itself.
  const Material& material(const std::string& name, const TomlValue& asked);

 private:
  TomlValue table_;
  const Bands& bands_;
  std::vector<std::string>& inputs_;
  std::map<std::string, Material> known_;
  std::set<std::string> being_read_;
};

using MaterialReader = Material (*)(const TomlValue& table, MaterialContext& context);
Material read_lambertian(const TomlValue& table, MaterialContext& context);
Material read_bilambertian(const TomlValue& table, MaterialContext& context);
Material read_transparent(const TomlValue& table, MaterialContext& context);
Material read_srm(const TomlValue& table, MaterialContext& context);
Material read_rpv(const TomlValue& table, MaterialContext& context);
Material read_hapke(const TomlValue& table, MaterialContext& context);
Material read_verstraete_pinty_dickinson(const TomlValue& table, MaterialContext& context);
Material read_tabulated(const TomlValue& table, MaterialContext& context);
Material read_waxy_leaf(const TomlValue& table, MaterialContext& context);
Material read_prospect(const TomlValue& table, MaterialContext& context);
Material read_mixture(const TomlValue& table, MaterialContext& context);
Material read_map(const TomlValue& table, MaterialContext& context);

Material read_material(const TomlValue& table, const std::string& name, MaterialContext& context);

// A surface without a diffuse part: what readers of lobes begin with.
Material black_material(const Bands& bands, bool opaque);
// `face` = "both" (default), "front" or "back": the faces that a lobe is on.
std::array<bool, 2> read_faces(const TomlValue& table);

}  // namespace bpms
