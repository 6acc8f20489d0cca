// Curves from text files of columns: a first column that increases and one of values, linear in between and
// never extrapolated. Columns are separated by commas, semicolons or white space; '#' starts a comment; lines
// before the first number are headers, and the last one with as many fields as there are columns names them.
// A row that repeats the one before it is passed over (the published table of the solar constant has one).
#pragma once
#include <string>
#include <vector>

#include "core/toml.h"
#include "simulate/materials/spectrum.h"

namespace bpms {

struct ColumnCurve {
  std::string path;
  std::vector<double> x, y;
  bool holds(double at) const { return !x.empty() && at >= x.front() && at <= x.back(); }
  double at(double where) const;  // within what it holds
};

// By a column's name, or its number, counted from 1.
ColumnCurve read_curve(const std::string& path, const std::string& column);
// "file", of which the second column counts, or { file = "...", column = "name" | number }.
ColumnCurve read_curve(const TomlValue& value, std::vector<std::string>& inputs);

// Values at the bands' wavelengths. What says the curve, `value`, is named where it does not reach a band.
std::vector<double> at_bands(const ColumnCurve& curve, const Bands& bands, const TomlValue& value);

// Irradiance or radiance of a source, per band: what read_spectrum takes ("brf" is the caller's), or
// { file = "ASTMG173.csv", column = "direct", unit_per = "nm" }: per nm of wavelength (W m-2 nm-1), or
// per "um" (default).
std::vector<double> read_source_spectrum(const TomlValue& value, const Bands& bands,
                                         std::vector<std::string>& inputs);

}  // namespace bpms
