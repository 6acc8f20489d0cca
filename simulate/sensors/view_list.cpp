#include "simulate/sensors/view_list.h"

#include <cmath>

#include "simulate/number_list.h"

namespace bpms {
namespace {

double within_sight(const TomlValue& value) {
  const double vza_deg = value.number();
  if (!(std::abs(vza_deg) <= steepest_deg))
    value.reject(
        fmt::format("view zenith {} degrees: expected at most {} from the vertical", vza_deg, steepest_deg));
  return vza_deg;
}

std::vector<ViewAngles> hemisphere_of_views(const TomlValue& table) {
  constexpr long long most = 1000;
  const long long zeniths = table.require("zeniths").integer(1, most);
  const long long azimuths = table.require("azimuths").integer(1, most);
  const TomlValue edge = table.get("most_deg");
  const double most_deg = edge ? edge.number(0.1, steepest_deg) : 75.0;
  std::vector<ViewAngles> out{{0, 0}};
  for (long long ring = 1; ring <= zeniths; ++ring)
    for (long long k = 0; k < azimuths; ++k)
      out.push_back({most_deg * static_cast<double>(ring) / static_cast<double>(zeniths),
                     360.0 * static_cast<double>(k) / static_cast<double>(azimuths)});
  return out;
}

}  // namespace

std::vector<ViewAngles> read_view_list(const TomlValue& table, const SensorContext& context) {
  const TomlValue plane = table.get("plane");
  const TomlValue views = table.get("views");
  const TomlValue hemisphere = table.get("hemisphere");
  const TomlValue zeniths = table.get("vza_deg");
  if (static_cast<bool>(plane) + static_cast<bool>(views) + static_cast<bool>(hemisphere) != 1)
    table.reject_choice(
        "expected one of plane = \"principal\" | \"cross\", views = [[vza, vaa], ...] and hemisphere = { "
        "zeniths = N, azimuths = M }");
  std::vector<ViewAngles> out;
  if (plane) {
    const std::string name = plane.one_of({"principal", "cross"});
    if (context.light.suns.empty())
      plane.reject("the principal and the cross plane need a sun: give views = [[vza, vaa], ...]");
    const double turn = name == "principal" ? 180.0 : 90.0;
    for (const double vza : read_number_list(table.require("vza_deg"), within_sight))
      out.push_back({vza, context.light.suns.front().azimuth_deg + turn});
    return out;
  }
  if (zeniths) zeniths.reject("expected vza_deg with plane only");
  if (hemisphere) return hemisphere_of_views(hemisphere);
  if (!views.is_array()) views.reject("expected [[vza, vaa], ...]");
  for (std::size_t i = 0; i < views.size(); ++i) {
    const std::vector<double> pair = views[i].numbers(2);
    out.push_back({within_sight(views[i][0]), pair[1]});
  }
  if (out.empty()) views.reject("expected at least one [vza, vaa]");
  return out;
}

}  // namespace bpms
