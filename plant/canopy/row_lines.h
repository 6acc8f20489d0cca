// Parallel lines, of rows or of ridges: across . xy = offset + k spacing. In a periodic domain of size (X, Y)
// they go over into themselves only when their wave vector is (m / X, n / Y) with whole m, n: either spacing
// and azimuth snap to the nearest such pair, or the domain's size does.
#pragma once
#include <Eigen/Core>

#include "core/toml.h"

namespace bpms {

struct PlantingField;

struct RowLines {
  Eigen::Vector2d along, across;  // unit
  double spacing_m = 0;
  double offset_m = 0;
};

// `what` ("rows") is for the note of what was snapped and by how much; `where` for a domain that would have
// to change too much.
RowLines fit_row_lines(double spacing_m, double azimuth, const char* what, const TomlValue& where,
                       PlantingField& field);

// Lines that cross a field of this size, or may.
long long row_line_count(const RowLines& lines, const Eigen::Vector2d& size_m);

}  // namespace bpms
