#include "simulate/materials/tabulated.h"

#include "core/text.h"
#include "core/units.h"
#include "simulate/materials/material.h"

namespace bpms {
namespace {

struct AxisPlace {
  std::size_t below, above;
  double t;
};

AxisPlace place_on(const std::vector<double>& axis, double value) {
  if (value <= axis.front()) return {0, 0, 0};
  if (value >= axis.back()) return {axis.size() - 1, axis.size() - 1, 0};
  const auto above =
      static_cast<std::size_t>(std::upper_bound(axis.begin(), axis.end(), value) - axis.begin());
  return {above - 1, above, (value - axis[above - 1]) / (axis[above] - axis[above - 1])};
}

// Cosine to degrees; 1 + rounding is 0.
double angle_deg(double cosine) {
  return degrees(std::acos(std::clamp(cosine, -1.0, 1.0)));
}

}  // namespace

TabulatedLobe::TabulatedLobe(BrfTable table)
    : FormulaLobe(table.brf.size(), !table.spectral), table_(std::move(table)) {
  make_sampler(1.5);
}

double TabulatedLobe::brf(const ReflectionAngles& angles, std::size_t band) const {
  const AxisPlace light = place_on(table_.light_deg, angle_deg(angles.mu_light)),
                  view = place_on(table_.view_deg, angle_deg(angles.mu_view)),
                  azimuth = place_on(table_.azimuth_deg, angle_deg(angles.cos_azimuth));
  const std::vector<double>& set = table_.brf[band];
  const std::size_t views = table_.view_deg.size(), azimuths = table_.azimuth_deg.size();
  const auto along_azimuth = [&](std::size_t i, std::size_t k) {
    const double* row = set.data() + (i * views + k) * azimuths;
    return row[azimuth.below] + azimuth.t * (row[azimuth.above] - row[azimuth.below]);
  };
  const auto along_view = [&](std::size_t i) {
    const double low = along_azimuth(i, view.below);
    return low + view.t * (along_azimuth(i, view.above) - low);
  };
  const double low = along_view(light.below);
  return low + light.t * (along_view(light.above) - low);
}

Material read_tabulated(const TomlValue& table, MaterialContext& context) {
  Material out = black_material(context.bands(), true);
  const std::string path = context.input_file(table.require("file"));
  BrfTable brf = parse_brf_table(path, read_text(path), context.bands());
  out.notes = brf.notes;
  SurfaceLobe lobe;
  lobe.on_face = read_faces(table);
  if (!brf.spectral) lobe.spectrum.assign(context.bands().count(), 1.0);
  lobe.lobe = std::make_shared<TabulatedLobe>(std::move(brf));
  out.lobes.push_back(std::move(lobe));
  return out;
}

}  // namespace bpms
