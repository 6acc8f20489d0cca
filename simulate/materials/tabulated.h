// A BRF given as numbers: over zeniths of light and view, relative azimuth (0: view on the light's side) and,
// where it depends on that, wavelength; linear in between, in degrees and nm. Beyond the last zenith its
// value is kept; wavelengths are never extrapolated.
#pragma once
#include <string>
#include <vector>

#include "simulate/materials/formula_lobe.h"
#include "simulate/materials/spectrum.h"

namespace bpms {

struct BrfTable {
  std::vector<double> light_deg, view_deg, azimuth_deg;  // increasing, each of one value or more
  std::vector<std::vector<double>> brf;                  // by set; [light][view][azimuth]
  bool spectral = false;                                 // one set a band; else one in all
  std::vector<std::string> notes;
  bool reciprocal = true;
};
BrfTable parse_brf_table(const std::string& path, std::string text, const Bands& bands);

class TabulatedLobe : public FormulaLobe {
 public:
  explicit TabulatedLobe(BrfTable table);
  double brf(const ReflectionAngles& angles, std::size_t band) const override;
  bool reciprocal() const override { return table_.reciprocal; }

 private:
  BrfTable table_;
};

}  // namespace bpms
