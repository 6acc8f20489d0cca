#include "simulate/materials/response_table.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "simulate/materials/bands.h"
#include "simulate/materials/column_lines.h"

namespace bpms {
namespace {

double number_in(const std::string& path, int line, const ColumnField& word, const char* what) {
  const auto value = parse_number(word.text);
  if (!value) bad_input({path, line, word.column}, "found {}, expected {}", in_quotes(word.text), what);
  return *value;
}

double at(const ResponseTable& table, std::size_t column, double nm) {
  const auto above = std::lower_bound(table.nm.begin(), table.nm.end(), nm);
  const auto i = static_cast<std::size_t>(above - table.nm.begin());
  const auto& values = table.response[column];
  if (i == table.nm.size() || nm < table.nm.front()) return 0;
  if (table.nm[i] == nm) return values[i];
  const double t = (nm - table.nm[i - 1]) / (table.nm[i] - table.nm[i - 1]);
  return values[i - 1] + t * (values[i] - values[i - 1]);
}

ResponseTable stepped(const ResponseTable& table, double step_nm) {
  ResponseTable out;
  out.names = table.names;
  out.response.resize(table.names.size());
  const auto first = static_cast<long>(std::ceil(table.nm.front() / step_nm));
  const auto last = static_cast<long>(std::floor(table.nm.back() / step_nm));
  for (long k = first; k <= last; ++k) {
    const double nm = static_cast<double>(k) * step_nm;
    out.nm.push_back(nm);
    for (std::size_t c = 0; c < out.names.size(); ++c) out.response[c].push_back(at(table, c, nm));
  }
  return out;
}

}  // namespace

double ResponseTable::width_nm(std::size_t row) const {
  if (nm.size() == 1) return 1;
  const double low = row == 0 ? nm[0] : nm[row - 1], high = row + 1 == nm.size() ? nm[row] : nm[row + 1];
  return 0.5 * (high - low);
}

ResponseTable read_response_table(const std::string& path, double step_nm) {
  ResponseTable out;
  const std::string text = read_text(path);
  for (ColumnLines lines(text); lines.next();) {
    const std::vector<ColumnField>& words = lines.fields();
    const int number = lines.number();
    if (out.names.empty()) {
      if (parse_number(words[0].text) || words.size() < 2)
        bad_input({path, number, 1}, "expected a header: a name for the wavelength and one for each band");
      for (std::size_t k = 1; k < words.size(); ++k) out.names.emplace_back(words[k].text);
      out.response.resize(out.names.size());
      continue;
    }
    if (words.size() != out.names.size() + 1)
      bad_input({path, number, 1}, "{} columns, expected {} as in the header", words.size(),
                out.names.size() + 1);
    const double nm = number_in(path, number, words[0], "a wavelength in nm");
    if (!out.nm.empty() && nm <= out.nm.back())
      bad_input({path, number, words[0].column}, "wavelength {} nm does not come after {} nm", nm,
                out.nm.back());
    if (!(nm >= shortest_wavelength_nm))
      bad_input({path, number, words[0].column}, "wavelength {}: expected nanometres", nm);
    out.nm.push_back(nm);
    for (std::size_t k = 1; k < words.size(); ++k) {
      const double response = number_in(path, number, words[k], "a response");
      // Measured responses dip a little below zero beside the band.
      constexpr double noise = 0.01;
      if (response < -noise)
        bad_input({path, number, words[k].column}, "response {}: expected one of at least 0", response);
      out.response[k - 1].push_back(std::max(0.0, response));
    }
  }
  if (out.nm.empty()) bad_input({path}, "no rows of a wavelength and responses");
  if (step_nm > 0 && out.nm.size() > 1) return stepped(out, step_nm);
  return out;
}

}  // namespace bpms
