// The structure report as JSON and as a tidy CSV table; keys and columns in docs/structure.md. Azimuths in
// the scene's convention.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/json.h"
#include "scene/structure/fisheye.h"
#include "scene/structure/scattering_table.h"
#include "scene/structure/structure.h"

namespace bpms {

struct StructureReport {
  const Scene* scene = nullptr;
  const CanopyStructure* structure = nullptr;
  std::vector<BandOptics> bands;  // that the tables are of
  std::vector<ScatteringTable> scattering;
  std::optional<FisheyePicture> fisheye;
  Eigen::Vector2d fisheye_at_m = Eigen::Vector2d::Zero();
  std::optional<double> overlap = {};  // between plants: share of the leaf area (plant/canopy/overlap.h)
};

// Of plants, the first thousand; the CSV has all.
Json structure_json(const StructureReport& report);
std::string structure_csv(const StructureReport& report);
// For people to read.
std::string structure_text(const StructureReport& report);

// An azimuth counter-clockwise from x in the scene's convention, 0..360 degrees.
double azimuth_in_convention_deg(double counter_clockwise, const Domain& domain);
// Bins of azimuth counter-clockwise from x, in the scene's convention.
std::vector<AngleBin> azimuth_bins_in_convention(const std::vector<AngleBin>& bins, const Domain& domain);

}  // namespace bpms
