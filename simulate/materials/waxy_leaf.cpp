// A leaf with a rough shiny surface on one or both faces: Fresnel's reflection from facets, and diffuse
// reflection and transmission beneath it ("coupled") or simply beside it ("lambertian").
#include "simulate/materials/beneath_surface.h"
#include "simulate/materials/material.h"
#include "simulate/materials/rough_specular.h"
#include "simulate/materials/spectral_sets.h"

namespace bpms {
namespace {

// A lobe that scatters `spectrum`, wherever that has to stand.
SurfaceLobe beneath(const std::shared_ptr<const EnteringLight>& view_face,
                    const std::shared_ptr<const EnteringLight>& light_face, bool transmits, bool separable,
                    const std::vector<double>& spectrum, std::array<bool, 2> on_face) {
  const std::vector<double> none;
  return {std::make_shared<BeneathSurface>(view_face, light_face, transmits, separable ? none : spectrum),
          separable ? spectrum : none, on_face};
}

}  // namespace

Material read_waxy_leaf(const TomlValue& table, MaterialContext& context) {
  Material out = read_bilambertian(table, context);
  std::vector<double> index = context.spectrum(table.require("refractive_index"), 1.0, 3.0);
  // Smoother ones would hardly be met by chance: srm has mirrors.
  const double roughness = table.require("roughness").number(0.02, 1.0);
  const TomlValue slopes = table.get("slopes"), diffuse = table.get("diffuse");
  const bool beckmann = slopes && slopes.one_of({"ggx", "beckmann"}) == "beckmann";
  const bool coupled = !diffuse || diffuse.one_of({"coupled", "lambertian"}) == "coupled";
  const std::array<bool, 2> shiny = read_faces(table);

  const bool separable = all_flat({&index});
  if (separable) index.resize(1);
  const auto specular = std::make_shared<RoughSpecular>(beckmann ? FacetSlopes::beckmann : FacetSlopes::ggx,
                                                        roughness, index, separable);
  out.lobes.push_back({specular,
                       separable ? std::vector<double>(context.bands().count(), 1.0) : std::vector<double>(),
                       shiny});
  if (!coupled) return out;

  const auto bare = std::make_shared<const EnteringLight>();
  const auto surface = std::make_shared<const EnteringLight>(specular->albedo());
  for (std::size_t face = 0; face < 2; ++face) {
    const std::array<bool, 2> here{face == 0, face == 1};
    const auto& own = shiny[face] ? surface : bare;
    const auto& other = shiny[1 - face] ? surface : bare;
    if (shiny[face]) {
      out.lobes.push_back(beneath(own, own, false, separable, out.reflectance[face], here));
      out.reflectance[face].assign(context.bands().count(), 0.0);
    }
    out.lobes.push_back(beneath(own, other, true, separable, out.transmittance, here));
  }
  out.transmittance.assign(context.bands().count(), 0.0);
  return out;
}

}  // namespace bpms
