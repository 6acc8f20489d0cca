#include "plant/canopy/domain.h"

#include <cmath>

#include "core/units.h"

namespace bpms {
namespace {

constexpr double farthest_side_m = 1e7;
// Streams of random numbers: the pattern's own is 0, those of the plants follow (place_plants.cpp).
constexpr std::uint64_t pattern_stream = 0;

// A canopy that reaches `factor` times as far as the farthest point of level ground that the sensor sees from
// the point below it: Lewis 1999, section 2.1.4, has 3 to 4 times.
double extent_for(const TomlValue& table, std::vector<std::string>& notes) {
  constexpr double usual_factor = 3.5, most_factor = 1000;
  const double height = table.require("height_m").positive();
  const double fov_deg = table.require("fov_deg").number(0, 180);
  const TomlValue zenith = table.get("zenith_deg");
  const double zenith_deg = zenith ? std::abs(zenith.number(-90, 90)) : 0;
  const TomlValue factor_key = table.get("factor");
  const double factor = factor_key ? factor_key.number(1, most_factor) : usual_factor;
  const double farthest_deg = zenith_deg + fov_deg / 2;
  constexpr double horizon_deg = 89.9;
  if (farthest_deg >= horizon_deg)
    table.reject(fmt::format(
        "a view {:.6g} degrees from the zenith with a field of {:.6g} degrees reaches {:.6g} degrees, to "
        "the horizon or beyond: no extent would hold what it sees; take boundary = \"periodic\"",
        zenith_deg, fov_deg, farthest_deg));
  const double seen = height * std::tan(radians(farthest_deg));
  if (!(seen > 0)) table.reject("a field of 0 degrees straight down has no extent: give size_m");
  const double side = 2 * factor * seen;
  notes.push_back(fmt::format(
      "extent {:.6g} x {:.6g} m: {:.4g} times the {:.6g} m from the point below a sensor {:.6g} m up to "
      "the farthest that it sees, {:.6g} degrees from the nadir",
      side, side, factor, seen, height, farthest_deg));
  return side;
}

Eigen::Vector2d read_size(const TomlValue& domain, bool periodic, std::vector<std::string>& notes) {
  const TomlValue extent = domain.get("extent_for");
  if (!extent) {
    const TomlValue size = domain.require("size_m");
    const std::vector<double> numbers = size.numbers(2);
    if (!(std::min(numbers[0], numbers[1]) > 0)) size.reject("expected two lengths above 0");
    if (std::max(numbers[0], numbers[1]) > farthest_side_m) size.reject("expected lengths up to 1e7 m");
    return {numbers[0], numbers[1]};
  }
  if (const TomlValue size = domain.get("size_m"))
    size.reject("the size is that of extent_for: give one of the two");
  if (periodic) extent.reject("a periodic canopy has no end: give size_m, or boundary = \"open\"");
  const double side = extent_for(extent, notes);
  if (side > farthest_side_m)
    extent.reject(fmt::format("gives a side of {:.6g} m, expected up to 1e7 m", side));
  return {side, side};
}

}  // namespace

PlantingField read_canopy_domain(const TomlValue& root, const CanopyReadOptions& options, Canopy& canopy) {
  const TomlValue domain = root.require("domain");
  if (const TomlValue boundary = domain.get("boundary"))
    canopy.periodic = boundary.one_of({"periodic", "open"}) == "periodic";
  canopy.size_m = read_size(domain, canopy.periodic, canopy.notes);
  constexpr long long largest_seed = 1'000'000'000'000;
  if (const TomlValue seed = domain.get("seed"))
    canopy.seed = static_cast<std::uint64_t>(seed.integer(0, largest_seed));
  if (options.seed) canopy.seed = *options.seed;
  PlantingField field{canopy.size_m, canopy.periodic, Philox(canopy.seed, pattern_stream)};
  field.most_plants = options.most_plants;
  if (const TomlValue snap = domain.get("snap")) {
    if (!canopy.periodic) snap.reject("nothing snaps in an open domain");
    field.snap_domain = snap.one_of({"rows", "domain"}) == "domain";
  }
  return field;
}

}  // namespace bpms
