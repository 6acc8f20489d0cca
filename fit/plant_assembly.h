// Fitted organs put together to a plant.
// All start at one common base, the plant's origin: the foot of the lowest stem, else the bud, else the mean
// of the leaves' bases. How far each organ's own base lies from it is reported, not lost; on request it is
// kept in the plant too, by a stem without surface from the origin to the base. An organ stands behind a
// rotation + with its direction around the stem as a_twist.
#pragma once
#include <string>
#include <vector>

#include "fit/fit.h"

namespace bpms {

struct FittedPlant {
  Plant plant;
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  // the common base in the frame of the measurements
  std::vector<std::size_t> organs;                     // those of `fits` that are in the plant
  std::vector<int> ids;                                // their organ ids in the plant
};

struct AssemblyOptions {
  std::string unit = "cm";  // of the text
  double width_m = 0;       // of leaves without edges; 0: they get no width
  std::optional<Eigen::Vector3d> bud_m;
  bool measured_bases = false;  // organs where they were measured, not all at the common base
};

// One plant of those fits (indices into `fits`) that succeeded.
FittedPlant assemble_plant(const std::string& name, const std::vector<OrganFit>& fits,
                           const std::vector<std::size_t>& members, const AssemblyOptions& options);

}  // namespace bpms
