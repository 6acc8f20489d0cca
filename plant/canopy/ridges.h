// Ridges and furrows: parallel ridges of one profile across. Heights are above the bottom of the furrows.
// d is the distance from the middle of the nearest ridge, w the width at its foot, t that of its flat top:
//   cosine     height (1 + cos(2 pi d / w)) / 2,
//   triangle   height (1 - 2 d / w),
//   trapezoid  height for d <= t / 2, then straight down to the foot,
// and 0 beyond w / 2.
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <string>

#include "core/toml.h"
#include "plant/canopy/pattern.h"
#include "plant/terrain.h"

namespace bpms {

struct Ridges {
  enum class Shape { cosine, triangle, trapezoid } shape = Shape::cosine;
  double height_m = 0;
  double width_m = 0;       // at the foot
  double top_m = 0;         // of a trapezoid
  RowLines lines;           // the middles of the ridges
  double resolution_m = 0;  // nodes are no further apart than that across the ridges

  double height_at(const Eigen::Vector2d& xy) const;
};

// [ridges]; spacing and azimuth are those of the field's rows where the table has none of its own.
Ridges read_ridges(const TomlValue& table, PlantingField& field);

// Ridges on level ground: the periodic domain exactly, or what covers the open one.
Terrain ridged_ground(const Ridges& ridges, const PlantingField& field, const TomlValue& table);
// The terrain with ridges added to it, its squares divided as finely as the ridges ask for.
Terrain ridged_terrain(const Ridges& ridges, const Terrain& below, bool periodic, const TomlValue& table);

}  // namespace bpms
