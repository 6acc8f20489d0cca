// Pictures of what was found: marks and ids at the points, a line through them in their order, red at the
// beginning and violet at the end.
#pragma once
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "calibrate/targets/target_kind.h"

namespace bpms {

// Bytes of a PNG.
std::string overlay_png(const cv::Mat& grey, const std::vector<Target>& targets,
                        const std::vector<Detection>& found);

}  // namespace bpms
