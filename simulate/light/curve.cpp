#include "simulate/light/curve.h"

#include <algorithm>

#include "core/text.h"
#include "simulate/light/light.h"
#include "simulate/materials/column_lines.h"

namespace bpms {
namespace {

std::size_t column_of(const std::string& column, const std::vector<std::vector<std::string>>& headers,
                      std::size_t count, const std::string& path) {
  const auto number = parse_integer(column);
  if (number) {
    if (*number < 2 || *number > static_cast<long long>(count))
      bad_input({path}, "no column {} of values: there are {}, the first one increasing", column, count);
    return static_cast<std::size_t>(*number) - 1;
  }
  for (auto header = headers.rbegin(); header != headers.rend(); ++header) {
    if (header->size() != count) continue;
    for (std::size_t i = 1; i < count; ++i)
      if ((*header)[i] == column) return i;
    std::string names;
    for (std::size_t i = 1; i < count; ++i) names += (i > 1 ? ", " : "") + in_quotes((*header)[i]);
    bad_input({path}, "no column {}: expected one of {}", in_quotes(column), names);
  }
  bad_input({path}, "no header names the columns: expected a number instead of {}", in_quotes(column));
}

}  // namespace

double ColumnCurve::at(double where) const {
  const auto above = std::lower_bound(x.begin(), x.end(), where);
  const auto i = static_cast<std::size_t>(above - x.begin());
  if (i == 0) return y.front();
  return y[i - 1] + (where - x[i - 1]) / (x[i] - x[i - 1]) * (y[i] - y[i - 1]);
}

ColumnCurve read_curve(const std::string& path, const std::string& column) {
  ColumnCurve out;
  out.path = path;
  const std::string text = read_text(path);
  std::vector<std::vector<std::string>> headers;
  std::size_t count = 0, chosen = 0;
  for (ColumnLines lines(text); lines.next();) {
    const std::vector<ColumnField>& fields = lines.fields();
    const int line_number = lines.number();
    const auto x = parse_number(fields.front().text);
    if (out.x.empty() && !x) {
      auto& header = headers.emplace_back();
      for (const ColumnField& field : fields) header.emplace_back(field.text);
      continue;
    }
    if (out.x.empty()) {
      count = fields.size();
      if (count < 2) bad_input({path, line_number}, "one column: expected two or more");
      chosen = column_of(column, headers, count, path);
    }
    if (fields.size() <= chosen)
      bad_input({path, line_number}, "{} columns: expected {}", fields.size(), count);
    const auto y = parse_number(fields[chosen].text);
    if (!x || !y)
      bad_input({path, line_number, (x ? fields[chosen] : fields.front()).column},
                "expected a number, found {}", in_quotes((x ? fields[chosen] : fields.front()).text));
    if (!out.x.empty() && *x == out.x.back() && *y == out.y.back()) continue;
    if (!out.x.empty() && *x <= out.x.back())
      bad_input({path, line_number, fields.front().column},
                "{} does not come after {}: expected an increasing "
                "first column",
                *x, out.x.back());
    out.x.push_back(*x);
    out.y.push_back(*y);
  }
  if (out.x.empty()) bad_input({path}, "no rows of numbers");
  return out;
}

ColumnCurve read_curve(const TomlValue& value, std::vector<std::string>& inputs) {
  if (!value.is_table() && !value.is_string())
    value.reject("expected \"file\" or { file = \"...\", column = \"...\" }");
  const TomlValue file = value.is_table() ? value.require("file") : value;
  std::string column = "2";
  if (value.is_table()) {
    if (const TomlValue key = value.get("column"))
      column = key.is_number() ? fmt::format("{}", key.integer(2, 100000)) : key.string();
  }
  inputs.push_back(file.file_relative(file.string()));
  return read_curve(inputs.back(), column);
}

std::vector<double> at_bands(const ColumnCurve& curve, const Bands& bands, const TomlValue& value) {
  if (bands.wavelengths_nm.empty()) value.reject("a spectrum needs [bands] wavelengths_nm");
  constexpr double longest_um = 100;  // no spectrum of light ends at 100 nm
  if (curve.x.back() <= longest_um)
    bad_input({curve.path}, "wavelengths from {} to {} look like micrometres (um): expected nm",
              curve.x.front(), curve.x.back());
  std::vector<double> out;
  for (std::size_t band = 0; band < bands.count(); ++band) {
    const double nm = bands.wavelengths_nm[band];
    if (!curve.holds(nm))
      value.reject(fmt::format("{} runs from {} to {} nm, which does not hold {}", curve.path,
                               curve.x.front(), curve.x.back(), bands.name(band)));
    out.push_back(curve.at(nm));
  }
  return out;
}

std::vector<double> read_source_spectrum(const TomlValue& value, const Bands& bands,
                                         std::vector<std::string>& inputs) {
  if (!value.is_table()) return read_spectrum(value, bands, 0.0, brightest, inputs);
  const TomlValue per = value.get("unit_per");
  const double scale = per && per.one_of({"um", "nm"}) == "nm" ? 1000.0 : 1.0;
  std::vector<double> out = at_bands(read_curve(value, inputs), bands, value);
  for (std::size_t band = 0; band < bands.count(); ++band) {
    out[band] *= scale;
    if (!(out[band] >= 0 && out[band] <= brightest))
      value.reject(
          fmt::format("{} in {}: expected a value from 0 to {}", out[band], bands.name(band), brightest));
  }
  return out;
}

}  // namespace bpms
