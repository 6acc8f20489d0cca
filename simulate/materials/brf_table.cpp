#include <algorithm>
#include <cmath>
#include <map>

#include "core/csv.h"
#include "simulate/materials/band_places.h"
#include "simulate/materials/tabulated.h"

namespace bpms {
namespace {

// The values of a column without repetition, and which of them each row has.
struct Axis {
  std::vector<double> values;
  std::vector<std::size_t> of_row;
  Axis(const CsvTable& table, const char* name, double low, double high) {
    const int column = table.require(name);
    std::map<double, std::size_t> found;
    std::vector<double> of;
    for (std::size_t row = 0; row < table.rows(); ++row) {
      const double value = table.number(row, column);
      if (!(value >= low && value <= high))
        bad_input(table.where(row, column), "{} is {}: expected {} to {}", name, value, low, high);
      of.push_back(value);
      found[value] = 0;
    }
    for (auto& [value, index] : found) {
      index = values.size();
      values.push_back(value);
    }
    for (const double value : of) of_row.push_back(found[value]);
  }
};

// The largest difference that exchanging light and view makes, over the sum.
double exchange_difference(const BrfTable& table) {
  double out = 0;
  const std::size_t n = table.light_deg.size(), azimuths = table.azimuth_deg.size();
  for (const std::vector<double>& set : table.brf)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < i; ++k)
        for (std::size_t a = 0; a < azimuths; ++a) {
          const double one = set[(i * n + k) * azimuths + a], other = set[(k * n + i) * azimuths + a];
          if (one + other > 0) out = std::max(out, std::abs(one - other) / (one + other));
        }
  return out;
}

void note_doubts(BrfTable& table) {
  for (const auto& [name, deg] :
       {std::pair{"theta_i_deg", &table.light_deg}, std::pair{"theta_r_deg", &table.view_deg}})
    if (deg->back() < 90)
      table.notes.push_back(
          fmt::format("{} ends at {:g}: the value there is kept up to 90 degrees", name, deg->back()));
  constexpr double printed_digits = 1e-3;
  if (table.light_deg != table.view_deg) {
    table.reciprocal = false;
    table.notes.push_back("theta_i_deg and theta_r_deg differ, so light and view may not be exchanged");
  } else if (const double difference = exchange_difference(table); difference > printed_digits) {
    table.reciprocal = false;
    table.notes.push_back(fmt::format(
        "not reciprocal: exchanging light and view changes it by up to {:.1f} %", 200 * difference));
  }
}

}  // namespace

BrfTable parse_brf_table(const std::string& path, std::string text, const Bands& bands) {
  const CsvTable csv = CsvTable::parse(path, std::move(text));
  if (csv.rows() == 0) bad_input({path}, "no rows");
  BrfTable out;
  const Axis light(csv, "theta_i_deg", 0, 90), view(csv, "theta_r_deg", 0, 90),
      azimuth(csv, "delta_phi_deg", 0, 180);
  out.light_deg = light.values;
  out.view_deg = view.values;
  out.azimuth_deg = azimuth.values;
  if (out.azimuth_deg.size() > 1 && !(out.azimuth_deg.front() == 0 && out.azimuth_deg.back() == 180))
    bad_input({path},
              "delta_phi_deg from {:g} to {:g}: expected 0 to 180, or one value where it does not matter",
              out.azimuth_deg.front(), out.azimuth_deg.back());
  out.spectral = csv.has("wavelength_nm");
  std::vector<double> nm{0};
  std::vector<std::size_t> nm_of_row(csv.rows(), 0);
  if (out.spectral) {
    Axis wavelength(csv, "wavelength_nm", 1e-3, 1e6);
    nm = wavelength.values;
    nm_of_row = wavelength.of_row;
  }
  const std::size_t angles = out.light_deg.size() * out.view_deg.size() * out.azimuth_deg.size();
  if (csv.rows() != angles * nm.size())
    bad_input({path},
              "{} rows: expected {} light zeniths x {} view zeniths x {} azimuths x {} wavelengths = {}",
              csv.rows(), out.light_deg.size(), out.view_deg.size(), out.azimuth_deg.size(), nm.size(),
              angles * nm.size());
  std::vector<std::vector<double>> by_nm(nm.size(), std::vector<double>(angles, -1.0));
  const int brf = csv.require("brf");
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const double value = csv.number(row, brf);
    if (!(value >= 0 && value <= 1000))
      bad_input(csv.where(row, brf), "brf is {}: expected 0 to 1000", value);
    double& place = by_nm[nm_of_row[row]][(light.of_row[row] * out.view_deg.size() + view.of_row[row]) *
                                              out.azimuth_deg.size() +
                                          azimuth.of_row[row]];
    if (place >= 0) bad_input(csv.where(row, brf), "a second row of the same angles and wavelength");
    place = value;
  }
  if (out.spectral) {
    for (const BandPlace& place : band_places(nm, bands, {path})) {
      std::vector<double> set(angles);
      for (std::size_t i = 0; i < angles; ++i)
        set[i] = by_nm[place.below][i] + place.t * (by_nm[place.above][i] - by_nm[place.below][i]);
      out.brf.push_back(std::move(set));
    }
  } else {
    out.brf = std::move(by_nm);
  }
  note_doubts(out);
  return out;
}

}  // namespace bpms
