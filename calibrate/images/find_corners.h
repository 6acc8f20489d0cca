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

struct FindOptions {
  std::string debug_folder;  // where a picture of what was found in each image goes; empty: nowhere
  bool overwrite = false;
};

// Finds the targets in all images, in parallel. A view of each target that an image shows. Skipped with a
// reason: missing, damaged and unreadable files, the same file twice, images of another size or by another
// camera or zoom (EXIF) than most of their camera's, and images without any target.
Observations find_corners(const std::vector<std::string>& images, const std::vector<Target>& targets,
                          const FindOptions& options = {});
inline Observations find_corners(const std::vector<std::string>& images, const Target& target,
                                 const FindOptions& options = {}) {
  return find_corners(images, std::vector<Target>{target}, options);
}

}  // namespace bpms
