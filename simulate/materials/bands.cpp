#include "simulate/materials/bands.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/text.h"
#include "simulate/materials/response_table.h"
#include "simulate/number_list.h"

namespace bpms {
namespace {

double wavelength_of(const TomlValue& value) {
  const double nm = value.number();
  constexpr double micrometres = 30;  // below, nobody's nanometres
  if (nm > 0 && nm < micrometres)
    value.reject(fmt::format("{} is {}: expected nanometres, and this looks like micrometres ({} nm?)",
                             value.name(), nm, nm * 1000));
  return value.number(shortest_wavelength_nm, longest_wavelength_nm);
}

// The bands that were asked for, over the wavelengths where any of them responds.
void add_responses(const ResponseTable& table, const std::vector<std::size_t>& columns, Bands& out) {
  for (std::size_t row = 0; row < table.nm.size(); ++row) {
    const auto responds = [&](std::size_t column) { return table.response[column][row] > 0; };
    if (std::any_of(columns.begin(), columns.end(), responds)) out.wavelengths_nm.push_back(table.nm[row]);
  }
  for (const std::size_t column : columns) {
    ResponseBand band;
    band.name = table.names[column];
    double sum = 0, mean = 0;
    std::size_t traced = 0;
    for (std::size_t row = 0; row < table.nm.size(); ++row) {
      if (traced >= out.wavelengths_nm.size() || table.nm[row] != out.wavelengths_nm[traced]) continue;
      const double weight = table.response[column][row] * table.width_nm(row);
      if (weight > 0) band.weights.emplace_back(traced, weight);
      sum += weight;
      mean += weight * table.nm[row];
      ++traced;
    }
    band.centre_nm = mean / sum;
    for (auto& weight : band.weights) weight.second /= sum;
    out.responses.push_back(std::move(band));
  }
}

Bands read_responses(const TomlValue& response, const TomlValue& table, std::vector<std::string>& inputs) {
  Bands out;
  const TomlValue names = table.get("bands"), step = table.get("step_nm"), how = table.get("weighting");
  if (table.has("wavelengths_nm"))
    table.get("wavelengths_nm").reject("expected one of wavelengths_nm and response");
  inputs.push_back(response.file_relative(response.string()));
  const ResponseTable file = read_response_table(inputs.back(), step ? step.number(0.1, 100.0) : 0.0);
  std::vector<std::size_t> columns;
  if (names) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::string name = names[i].one_of(file.names);
      columns.push_back(static_cast<std::size_t>(std::find(file.names.begin(), file.names.end(), name) -
                                                 file.names.begin()));
    }
    if (columns.empty()) names.reject("expected at least one band");
  } else {
    for (std::size_t i = 0; i < file.names.size(); ++i) columns.push_back(i);
  }
  for (const std::size_t column : columns) {
    const auto& values = file.response[column];
    if (!(*std::max_element(values.begin(), values.end()) > 0))
      response.reject(fmt::format("band {} responds nowhere in {}", file.names[column], inputs.back()));
  }
  out.sampled = how && how.one_of({"exact", "sampled"}) == "sampled";
  constexpr std::size_t most_sampled = 8;  // one wavelength a band travels with a path
  if (out.sampled && columns.size() > most_sampled)
    how.reject(fmt::format("at most {} bands are sampled, these are {}: expected weighting = \"exact\"",
                           most_sampled, columns.size()));
  add_responses(file, columns, out);
  return out;
}

}  // namespace

std::string Bands::name(std::size_t band) const {
  if (wavelengths_nm.empty()) return fmt::format("band {}", band + 1);
  return fmt::format("band {} ({} nm)", band + 1, wavelengths_nm[band]);
}

double Bands::written_nm(std::size_t band) const {
  if (!responses.empty()) return responses[band].centre_nm;
  return wavelengths_nm.empty() ? std::numeric_limits<double>::quiet_NaN() : wavelengths_nm[band];
}

std::string Bands::written_name(std::size_t band) const {
  return responses.empty() ? std::string() : responses[band].name;
}

std::vector<double> Bands::integrate(const std::vector<double>& traced) const {
  if (responses.empty()) return traced;
  std::vector<double> out;
  for (const ResponseBand& band : responses) {
    double sum = 0;
    for (const auto& weight : band.weights) sum += weight.second * traced[weight.first];
    out.push_back(sum);
  }
  return out;
}

Bands read_bands(const TomlValue& table, std::vector<std::string>& inputs) {
  Bands out;
  if (!table) return out;
  if (const TomlValue response = table.get("response")) return read_responses(response, table, inputs);
  const TomlValue list = table.get("wavelengths_nm");
  if (!list) table.reject_choice("expected one of wavelengths_nm and response");
  out.wavelengths_nm = read_number_list(list, wavelength_of);
  return out;
}

}  // namespace bpms
