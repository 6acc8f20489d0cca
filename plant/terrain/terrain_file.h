// Height fields from ESRI ASCII grids (.asc, also gzipped): ncols, nrows, xllcorner or xllcenter, yllcorner
// or yllcenter, cellsize, NODATA_value, then the rows from north to south. Each value is the height at the
// centre of its cell: a grid of n columns is (n - 1) cellsize wide.
#pragma once
#include <string>
#include <string_view>

#include "plant/terrain.h"

namespace bpms {
// Without a mesh yet. Missing or extra values, and places without data, are bad_input with line and column.
Terrain read_terrain_file(const std::string& path);
Terrain parse_terrain(const std::string& path, std::string_view text);
}  // namespace bpms
