// Rasters of maps: PGM (P2 or P5, 8 or 16 bits), PNG (grey or palette, up to 16 bits; of a palette the index
// counts) or CSV (rows of numbers, from the top). The file's content decides, not its name.
#pragma once
#include <string>

#include "simulate/materials/raster.h"

namespace bpms {

inline constexpr int most_raster_value = 65535;
inline constexpr std::size_t most_raster_pixels = std::size_t{1} << 26;

// Integers from 0 to 65535 as they stand in the file; in CSV too.
Raster read_integers(const std::string& path);
// Heights: PGM and PNG as parts of their full scale, from 0 to 1; CSV as they stand.
Raster read_heights(const std::string& path);
// The same from the file's bytes; `path` stands in messages.
Raster parse_integers(const std::string& path, const std::string& bytes);
Raster parse_heights(const std::string& path, const std::string& bytes);

}  // namespace bpms
