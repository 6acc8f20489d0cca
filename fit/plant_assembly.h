// Fitted organs put together to a plant.
// The axes that were measured start at one common base, the plant's origin: the foot of the lowest stem, or
// where no stem was digitised the mean of the leaves' bases. How far each organ's own base lies from it is
// reported, not lost. A leaf stands behind a rotation + with its direction around the stem as a_twist.
#pragma once
#include <string>
#include <vector>

#include "fit/fit.h"

namespace bpms {

struct FittedPlant {
  Plant plant;
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  // the common base in the frame of the measurements
  std::vector<std::size_t> organs;                     // of `fits`, in order of the plant's organ ids
};

struct AssemblyOptions {
  std::string unit = "cm";  // of the text
  double width_m = 0;       // of leaves without edges; 0: they get no width
};

// One plant of those fits (indices into `fits`) that succeeded.
FittedPlant assemble_plant(const std::string& name, const std::vector<OrganFit>& fits,
                           const std::vector<std::size_t>& members, const AssemblyOptions& options);

}  // namespace bpms
