// What a reconstruction says about itself, as JSON (keys: docs/reconstruction.md).
#pragma once
#include "core/json.h"
#include "reconstruct/points/disparity_check.h"
#include "reconstruct/points/frame.h"
#include "reconstruct/points/rim.h"
#include "reconstruct/reconstruct.h"

namespace bpms {

// points, points_total, rejected, reprojection_rms_px, curves; coordinates in `frame`, pixels by the rig.
Json reconstruction_json(const Vectors& vectors, const Rig& rig, const Frame& frame);
Json rejected_json(const Vectors& vectors);
Json check_json(const DisparityCheck& check);
Json rim_figures(const Rim& rim);  // {name, value, sigma, unit, note}

}  // namespace bpms
