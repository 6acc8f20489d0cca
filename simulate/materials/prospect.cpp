// A leaf by its constituents: PROSPECT gives the reflectance and transmittance of a bi-Lambertian material.
#include "core/units.h"
#include "simulate/materials/band_places.h"
#include "simulate/materials/material.h"
#include "simulate/materials/prospect_table.h"

namespace bpms {
namespace {

struct Constituent {
  const char* key;
  double most;       // more than any leaf has: a slip of the unit
  const char* unit;  // what to expect
};
// In the order of LeafContent.
constexpr Constituent constituents[leaf_constituents] = {
    {"cab_ug_cm2", 200, "ug cm-2 (1 g m-2 is 100 ug cm-2)"},
    {"car_ug_cm2", 100, "ug cm-2 (1 g m-2 is 100 ug cm-2)"},
    {"ant_ug_cm2", 100, "ug cm-2 (1 g m-2 is 100 ug cm-2)"},
    {"brown", 10, "arbitrary units"},
    {"cw_cm", 0.2, "cm, the same as g cm-2 (10 mg cm-2 or 100 g m-2 is 0.01 cm)"},
    {"cm_g_cm2", 0.1, "g cm-2 (10 mg cm-2 or 100 g m-2 is 0.01 g cm-2)"},
    {"prot_g_cm2", 0.05, "g cm-2 (10 mg cm-2 or 100 g m-2 is 0.01 g cm-2)"},
    {"cbc_g_cm2", 0.1, "g cm-2 (10 mg cm-2 or 100 g m-2 is 0.01 g cm-2)"},
};
constexpr std::size_t dry_matter = 5, proteins = 6, carbon_based = 7;

LeafContent read_content(const TomlValue& table, const ProspectTable& coefficients) {
  LeafContent out{};
  for (std::size_t i = 0; i < leaf_constituents; ++i) {
    const TomlValue given = table.get(constituents[i].key);
    if (!given) continue;
    out[i] = given.number();
    if (!(out[i] >= 0 && out[i] <= constituents[i].most))
      given.reject(fmt::format("{} is {}: expected 0 to {} {}", given.name(), out[i], constituents[i].most,
                               constituents[i].unit));
    if (out[i] > 0 && coefficients.absorption[i].empty())
      given.reject(fmt::format("the coefficients have no column {}, which {} = {} needs", prospect_column(i),
                               constituents[i].key, out[i]));
  }
  table.require(constituents[0].key);
  table.require("cw_cm");
  const bool parts = table.has("prot_g_cm2") || table.has("cbc_g_cm2");
  if (!parts && !table.has("cm_g_cm2")) table.reject_choice("expected cm_g_cm2, or prot_g_cm2 and cbc_g_cm2");
  if (out[dry_matter] > 0 && (out[proteins] > 0 || out[carbon_based] > 0))
    table.require("cm_g_cm2")
        .reject(
            "proteins and carbon-based constituents make up the dry matter: expected cm_g_cm2 or those two");
  return out;
}

}  // namespace

Material read_prospect(const TomlValue& table, MaterialContext& context) {
  Material out = black_material(context.bands(), false);
  const TomlValue file = table.require("coefficients");
  const std::string path = context.input_file(file);
  const ProspectTable coefficients = read_prospect_table(path);
  const double layers = table.require("n_layers").number(1.0, 10.0);
  const double cone_rad = radians(table.has("cone_deg") ? table.require("cone_deg").number(1.0, 90.0) : 40.0);
  const LeafContent content = read_content(table, coefficients);
  const std::vector<BandPlace> places = band_places(coefficients.nm, context.bands(), {path});
  for (std::size_t band = 0; band < places.size(); ++band) {
    double k = 0;
    for (std::size_t i = 0; i < leaf_constituents; ++i)
      if (content[i] > 0) k += content[i] * places[band].of(coefficients.absorption[i]);
    const PlateOptics leaf =
        prospect_leaf(layers, places[band].of(coefficients.refractive_index), k / layers, cone_rad);
    out.reflectance[0][band] = leaf.reflectance;
    out.transmittance[band] = leaf.transmittance;
  }
  out.reflectance[1] = out.reflectance[0];
  return out;
}

}  // namespace bpms
