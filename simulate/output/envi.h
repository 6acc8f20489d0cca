// ENVI image cubes: raw float32, little-endian, band sequential (.img), with a text header (.hdr) of the same
// name. An image keeps its pixels; a list of views becomes one line of as many samples. Values without a
// number are -9999, which the header names.
#pragma once
#include "simulate/simulate.h"

namespace bpms {

struct EnviCube {
  std::string header, pixels;  // contents of the two files
};
inline constexpr float envi_no_value = -9999.0f;

// Radiance of images (irradiance of receivers), reflectance of lists of views; or its standard errors.
EnviCube envi_cube(const Simulation& simulation, const SensorResult& result, bool standard_errors,
                   const std::string& provenance);
// The .img of each sensor, then that of its standard errors: PREFIX_SENSOR.img and PREFIX_SENSOR_se.img, or
// FOLDER/SENSOR.img when the prefix ends in a slash. The header lies beside it as .hdr.
std::string envi_path(const Simulation& simulation, std::size_t sensor, const std::string& prefix,
                      bool standard_errors);
std::string envi_header_path(const std::string& image_path);

}  // namespace bpms
