// The corners of a target in image files.
#pragma once
#include <string>
#include <vector>

#include "calibrate/observations.h"
#include "calibrate/targets/target.h"

namespace bpms {

// The files that the arguments name; patterns that the shell left alone ('left[0-9]*.jpg') are expanded here.
// A name or pattern that matches nothing stays, and is skipped later.
std::vector<std::string> expand_patterns(const std::vector<std::string>& arguments);

// Finds the targets in all images, in parallel. A view of each target that an image shows. Missing and
// unreadable files, images of another size than most of their camera's, and images without any target are
// skipped with a reason.
Observations find_corners(const std::vector<std::string>& images, const std::vector<Target>& targets);
inline Observations find_corners(const std::vector<std::string>& images, const Target& target) {
  return find_corners(images, std::vector<Target>{target});
}

}  // namespace bpms
