#include "simulate/output/romc_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "core/error.h"
#include "core/units.h"
#include "simulate/output/quantity.h"

namespace bpms {
namespace {

// "brfpp", "brfop", or nothing for a sensor that lies in neither plane.
std::string plane_of(const Sensor& sensor, const Sun& sun) {
  if (sensor.type != "brf") return {};
  constexpr double straight = 1e-6;
  bool principal = true, cross = true;
  for (std::size_t view = 0; view < sensor.views(); ++view) {
    if (sensor.vza_deg(view) == 0) continue;
    const double turn = radians(sensor.vaa_deg(view) - sun.azimuth_deg);
    principal = principal && std::abs(std::sin(turn)) < straight;
    cross = cross && std::abs(std::cos(turn)) < straight;
  }
  return principal ? "brfpp" : cross ? "brfop" : "";
}

std::string band_suffix(const Bands& bands, std::size_t band) {
  if (bands.written() == 1) return {};
  const double nm = bands.written_nm(band);
  return std::isfinite(nm) ? fmt::format("_{:g}nm", nm) : fmt::format("_band{}", band + 1);
}

// Within (-pi, pi].
double wrapped(double angle) {
  const double turn = std::remainder(angle, 2 * pi);
  constexpr double hair = 1e-9;  // rounding, which would write -0.000000
  if (std::abs(turn) < hair) return 0;
  return turn <= -pi + hair ? pi : turn;
}

std::size_t part_of_file(const SensorResult& result, Component component) {
  for (std::size_t p = 0; p < result.parts.size(); ++p) {
    const Part& part = result.parts[p];
    if (part.component == component && part.order == every_order && part.sun == every_sun) return p;
  }
  fail(ErrorKind::internal, {}, "no part {}", name_of(component));
}

}  // namespace

std::vector<RomcFile> romc_files(const Simulation& simulation, const std::string& experiment) {
  if (simulation.light.suns.size() != 1 || simulation.light.sky)
    bad_input({experiment}, "files of reflectance factors need one sun and no sky");
  const std::filesystem::path path(experiment);
  std::vector<RomcFile> out;
  std::set<std::string> done;
  for (std::size_t s = 0; s < simulation.sensors.size(); ++s) {
    const std::string plane = plane_of(*simulation.sensors[s], simulation.light.suns.front());
    if (plane.empty() || !done.insert(plane).second) continue;
    for (std::size_t band = 0; band < simulation.bands.written(); ++band)
      for (const Component part : {Component::all, Component::uc_sgl, Component::co_sgl, Component::mlt}) {
        const std::string measurement = part == Component::all ? plane : plane + "_" + name_of(part);
        const std::string name =
            measurement + "_bpms-" + path.filename().string() + band_suffix(simulation.bands, band) + ".mes";
        out.push_back({(path.parent_path() / name).string(), s, band, measurement, part});
      }
  }
  if (out.empty())
    bad_input({experiment}, "no sensor of type \"brf\" lies in the principal or the cross plane");
  return out;
}

std::string romc_text(const Simulation& simulation, const Result& result, const RomcFile& file) {
  const SensorResult& of = result.sensors.at(file.sensor);
  const Sun& sun = simulation.light.suns.front();
  const std::size_t bands = simulation.bands.written(), part = part_of_file(of, file.component);
  const double scale = reflectance_scale(simulation, Origin::total)[file.band];
  std::string rows;
  std::size_t count = 0;
  for (std::size_t view = 0; view < of.samples.size(); ++view) {
    if (of.samples[view] == 0) continue;
    ++count;
    const double vza = radians(of.sensor->vza_deg(view));
    const double vaa = radians(of.sensor->vaa_deg(view)) + (vza < 0 ? pi : 0);
    const std::size_t at = view * bands + file.band;
    rows += fmt::format("{:.6f} {:.6f} {:.6f} {:.6f} {:.6f}\n", radians(sun.zenith_deg), std::abs(vza),
                        wrapped(radians(sun.azimuth_deg) - vaa), of.radiance[part].value[at] * scale,
                        of.radiance[part].standard_error[at] * scale);
  }
  return fmt::format("{:4d} {:4d} {:.6f}\n", count, 5, -1.0) + rows;
}

}  // namespace bpms
