// `bpms calibrate --check rig.toml`: does the rig still hold?
#pragma once
#include <string>
#include <vector>

#include "apps/bpms/verb.h"

namespace bpms {

struct CheckRigArguments {
  std::string rig;
  std::vector<std::string> images;
  std::string target;
  double corner_sigma_px = 0, least_p = 1e-3;
  bool no_warp = false, ignore_identity = false;
};
// Prints the verdict; Error of the kind refused (exit 5) when the rig does not hold.
void check_rig_of(const Cli& cli, const CheckRigArguments& arguments);

}  // namespace bpms
