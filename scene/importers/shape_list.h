// Lists of shapes with a formula, one a line, metres, '#' comments, optionally gzipped:
//   sphere    x y z r                                       [material]
//   ellipsoid x y z rx ry rz [rz_deg ry_deg rx_deg]         [material]   turned about x first, then y, then z
//   spheroid  x y z r_across r_along [ax ay az]             [material]   its axis; z unless given
//   cylinder  x0 y0 z0 x1 y1 z1 r       [open | closed]     [material]   closed unless said
//   cone      x0 y0 z0 x1 y1 z1 r0 r1   [open | closed]     [material]   radii at its ends; one may be 0
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "scene/geometry/shape.h"
#include "scene/importers/materials.h"

namespace bpms {
// `material`: the name for lines that have none; empty: each line needs one. Whatever is wrong is bad_input
// with line and column.
std::vector<Shape> read_shape_list(const std::string& path, const std::string& material,
                                   const SourceLocation& where, MaterialNames& names);
std::vector<Shape> parse_shape_list(const std::string& path, std::string_view text,
                                    const std::string& material, const SourceLocation& where,
                                    MaterialNames& names);
}  // namespace bpms
