// The corners of a target in image files.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "calibrate/observations.h"
#include "calibrate/targets/target.h"

namespace bpms {

// The files that the arguments name; patterns that the shell left alone ('left[0-9]*.jpg') are expanded here.
// A name or pattern that matches nothing stays, and is skipped later.
std::vector<std::string> expand_patterns(const std::vector<std::string>& arguments);

// Finds the target in all images, in parallel. Missing and unreadable files, images of another size than most
// of their camera's, and images without the whole board are skipped with a reason. `name_of` says which
// camera and frame an image is of.
using ImageNaming = std::function<ImageName(const std::string& path)>;
Observations find_corners(const std::vector<std::string>& images, const Target& target,
                          const ImageNaming& name_of = parse_image_name);

}  // namespace bpms
