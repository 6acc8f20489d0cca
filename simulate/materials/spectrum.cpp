#include "simulate/materials/spectrum.h"

#include <algorithm>
#include <cmath>

#include "core/csv.h"
#include "core/text.h"

namespace bpms {
namespace {

struct Table {
  std::vector<double> nm;
  std::vector<double> value;
  void add(double x, double y, const SourceLocation& where) {
    if (!nm.empty() && x <= nm.back())
      bad_input(where, "wavelength {} nm does not come after {} nm: expected increasing wavelengths", x,
                nm.back());
    nm.push_back(x);
    value.push_back(y);
  }
};

// Comma-separated with or without a header, or white-space separated; the first two columns count.
Table read_table(const std::string& path) {
  Table out;
  const std::string text = read_text(path);
  int line_number = 0;
  bool header_allowed = true;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string line = text.substr(at, end - at);
    at = end + 1;
    ++line_number;
    if (const std::size_t semicolon = line.find(';'), comma = line.find(',');
        semicolon != std::string::npos && comma != std::string::npos &&
        line.find('#') > std::max(semicolon, comma))
      bad_input({path, line_number}, "found {} with both ; and ,: expected points as decimal signs",
                in_quotes(line));
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
    TokenReader reader(path, line);
    const auto first = reader.next();
    if (!first) continue;
    const auto second = reader.next();
    const auto x = parse_number(first->text);
    const auto y = second ? parse_number(second->text) : std::nullopt;
    const SourceLocation where{path, line_number,
                               x ? (second ? second->column : first->column) : first->column};
    if (!x && header_allowed) {
      header_allowed = false;
      continue;
    }
    header_allowed = false;
    if (!x || !y) bad_input(where, "expected a wavelength in nm and a value, found {}", in_quotes(line));
    out.add(*x, *y, where);
  }
  if (out.nm.empty()) bad_input({path}, "no rows of wavelength and value");
  return out;
}

Table table_of(const TomlValue& value) {
  Table out;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const std::vector<double> row = value[i].numbers(2);
    out.add(row[0], row[1], value[i].where());
  }
  if (out.nm.empty()) value.reject("expected at least one [nm, value]");
  return out;
}

double interpolate(const Table& table, double nm) {
  const auto above = std::lower_bound(table.nm.begin(), table.nm.end(), nm);
  const auto i = static_cast<std::size_t>(above - table.nm.begin());
  if (*above == nm) return table.value[i];
  const double t = (nm - table.nm[i - 1]) / (table.nm[i] - table.nm[i - 1]);
  return table.value[i - 1] + t * (table.value[i] - table.value[i - 1]);
}

void require_within(const TomlValue& value, double number, double low, double high, const std::string& what) {
  if (!(number >= low && number <= high))
    value.reject(fmt::format("{} is {}: expected a value from {} to {}", what, number, low, high));
}

}  // namespace

std::vector<double> read_spectrum(const TomlValue& value, const Bands& bands, double low, double high,
                                  std::vector<std::string>& inputs) {
  if (value.is_number()) {
    const double number = value.number();
    require_within(value, number, low, high, value.name());
    return std::vector<double>(bands.count(), number);
  }
  Table table;
  if (value.is_string()) {
    inputs.push_back(value.file_relative(value.string()));
    table = read_table(inputs.back());
  } else if (value.is_array()) {
    table = table_of(value);
  } else {
    value.reject("expected a number, a table [[nm, value], ...] or \"spectrum.csv\"");
  }
  if (bands.wavelengths_nm.empty()) value.reject("a spectrum needs [bands] wavelengths_nm or response");
  std::vector<double> out;
  for (std::size_t band = 0; band < bands.count(); ++band) {
    const double nm = bands.wavelengths_nm[band];
    constexpr double micrometres = 30;  // no spectrum in nm ends there
    if (table.nm.back() < micrometres && nm > micrometres)
      value.reject(
          fmt::format("{} is given from {} to {}: expected nanometres, and these look like micrometres",
                      value.name(), table.nm.front(), table.nm.back()));
    if (nm < table.nm.front() || nm > table.nm.back())
      value.reject(fmt::format("{} is given from {} to {} nm, which does not hold {}", value.name(),
                               table.nm.front(), table.nm.back(), bands.name(band)));
    const double number = interpolate(table, nm);
    require_within(value, number, low, high, fmt::format("{} in {}", value.name(), bands.name(band)));
    out.push_back(number);
  }
  return out;
}

}  // namespace bpms
