#include "simulate/output/recording.h"

#include <cmath>

#include "core/units.h"
#include "simulate/output/netcdf_reader.h"
#include "simulate/output/output.h"

namespace bpms {
namespace {

// A sensor of which only the angles of its views are known.
class RecordedSensor : public Sensor {
 public:
  std::vector<double> zeniths_deg, azimuths_deg;
  Measures what = Measures::radiance;
  double faces_z = 0;

  std::size_t views() const override { return zeniths_deg.size(); }
  Ray start(std::size_t, const SensorNumbers&, const Extent&) const override {
    throw Error(ErrorKind::internal, "a recorded sensor has no rays");
  }
  Measures measures() const override { return what; }
  std::optional<Eigen::Vector3d> faces(std::size_t) const override {
    if (faces_z == 0) return std::nullopt;
    return Eigen::Vector3d(0, 0, faces_z);
  }
  double vza_deg(std::size_t view) const override { return zeniths_deg[view]; }
  double vaa_deg(std::size_t view) const override { return azimuths_deg[view]; }
};

std::vector<std::string> source_names(const Light& light) {
  std::vector<std::string> out;
  for (const Sun& sun : light.suns) out.push_back(sun.name);
  if (light.sky) out.emplace_back("sky");
  return out;
}

std::vector<std::vector<double>> factor_spectra(const Simulation& simulation) {
  std::vector<std::vector<double>> out;
  for (const Material& material : simulation.materials) {
    for (const auto& reflectance : material.reflectance) out.push_back(reflectance);
    out.push_back(material.transmittance);
  }
  for (const Material& material : simulation.materials)
    for (const SurfaceLobe& lobe : material.lobes)
      if (!lobe.spectrum.empty()) out.push_back(lobe.spectrum);
  return out;
}

std::vector<double> flat(const std::vector<std::vector<double>>& rows) {
  std::vector<double> out;
  for (const auto& row : rows) out.insert(out.end(), row.begin(), row.end());
  return out;
}

// Rows of a matrix variable.
std::vector<std::vector<double>> rows_of(const NetcdfReader& file, const std::string& variable) {
  const std::vector<double> all = file.numbers(variable);
  const std::vector<std::size_t> shape = file.shape(variable);
  std::vector<std::vector<double>> out;
  for (std::size_t r = 0; r < shape.at(0); ++r) {
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(r * shape.at(1));
    out.emplace_back(first, first + static_cast<std::ptrdiff_t>(shape.at(1)));
  }
  return out;
}

Estimates estimates_of(const NetcdfReader& file, const std::string& variable) {
  return {file.numbers(variable), file.numbers(variable + "_se")};
}

void read_histograms(const NetcdfReader& file, const std::string& prefix, SensorResult& result) {
  const std::vector<double> first = file.numbers(prefix + "interaction_first");
  const std::vector<double> exponents = file.numbers(prefix + "interaction_exponents");
  const std::vector<double> sums = file.numbers(prefix + "interaction_sums");
  const std::vector<std::size_t> shape = file.shape(prefix + "interaction_sums");
  const std::size_t factors = file.shape(prefix + "interaction_exponents").at(1),
                    per_node = shape.at(1) * shape.at(2);
  const std::size_t nodes = shape.at(0);
  for (std::size_t view = 0; view + 1 < first.size(); ++view) {
    InteractionHistogram& to = result.histograms.emplace_back();
    to.factors = factors;
    to.sums_per_node = shape[1];
    to.batches = shape[2];
    if (!(first[view] >= 0 && first[view] <= first[view + 1] &&
          first[view + 1] <= static_cast<double>(nodes)))
      bad_input({file.path()}, "{}interaction_first does not count up to the {} nodes there are", prefix,
                nodes);
    const auto from = static_cast<std::size_t>(first[view]), end = static_cast<std::size_t>(first[view + 1]);
    for (std::size_t n = from; n < end; ++n) {
      for (std::size_t f = 0; f < factors; ++f) {
        const double exponent = exponents[n * factors + f];
        if (!(exponent >= 0 && exponent < 65536)) bad_input({file.path()}, "an exponent is {}", exponent);
        to.exponents.push_back(static_cast<std::uint16_t>(exponent));
      }
      for (std::size_t k = 0; k < per_node; ++k) to.sums.push_back(sums[n * per_node + k]);
    }
  }
}

void read_light_and_bands(const NetcdfReader& file, Simulation& out) {
  const std::vector<double> nm = file.numbers("traced_wavelength");
  if (!(nm.size() == 1 && std::isnan(nm[0]))) out.bands.wavelengths_nm = nm;
  const std::vector<std::string> names = file.words("source");
  const auto light = rows_of(file, "source_light");
  const std::vector<double> zenith = file.numbers("source_zenith"), azimuth = file.numbers("source_azimuth");
  for (std::size_t s = 0; s < names.size(); ++s) {
    if (std::isnan(zenith.at(s))) {
      out.light.sky = Sky{light.at(s), nullptr};
      continue;
    }
    Sun sun;
    sun.name = names[s];
    sun.zenith_deg = zenith[s];
    sun.azimuth_deg = azimuth.at(s);
    sun.direction =
        direction_from_angles(radians(sun.zenith_deg), radians(sun.azimuth_deg), out.scene.domain);
    sun.irradiance = light[s];
    out.light.suns.push_back(std::move(sun));
  }
}

void read_materials(const NetcdfReader& file, Simulation& out) {
  const auto spectra = rows_of(file, "factor_spectrum");
  std::size_t next_lobe = 3 * file.words("material").size();
  const std::vector<double> lobes = file.numbers("material_lobes");
  for (const std::string& name : file.words("material")) {
    const std::size_t m = out.materials.size();
    Material& material = out.materials.emplace_back();
    material.name = name;
    material.reflectance = {spectra.at(3 * m), spectra.at(3 * m + 1)};
    material.transmittance = spectra.at(3 * m + 2);
    for (int k = 0; k < static_cast<int>(lobes.at(m)); ++k)
      material.lobes.push_back({nullptr, spectra.at(next_lobe++), {true, true}});
    out.scene.materials.push_back(name);
  }
}

}  // namespace

void write_recording(const Simulation& simulation, NetcdfWriter& file) {
  const auto& nm = simulation.bands.wavelengths_nm;
  const std::size_t bands = simulation.bands.count();
  file.dimension("traced", bands);
  file.variable("traced_wavelength", {"traced"}, nm.empty() ? std::vector<double>{std::nan("")} : nm,
                {{"units", "nm"}, {"long_name", "wavelength that was traced"}});
  const std::vector<std::string> sources = source_names(simulation.light);
  file.dimension("source", sources.size());
  file.words("source", "source", sources, {{"long_name", "source of light"}});
  std::vector<double> light, zenith, azimuth;
  for (const Sun& sun : simulation.light.suns) {
    light.insert(light.end(), sun.irradiance.begin(), sun.irradiance.end());
    zenith.push_back(sun.zenith_deg);
    azimuth.push_back(sun.azimuth_deg);
  }
  if (simulation.light.sky) {
    light.insert(light.end(), simulation.light.sky->radiance.begin(), simulation.light.sky->radiance.end());
    zenith.push_back(std::nan(""));
    azimuth.push_back(std::nan(""));
  }
  file.variable(
      "source_light", {"source", "traced"}, light,
      {{"long_name", "of a sun, irradiance on its normal plane; of the sky, horizontal irradiance / pi"}});
  file.variable("source_zenith", {"source"}, zenith,
                {{"units", "degree"}, {"long_name", "sun zenith angle"}});
  file.variable("source_azimuth", {"source"}, azimuth,
                {{"units", "degree"}, {"long_name", "sun azimuth angle"}});
  const std::vector<std::string> factors = factor_names(simulation);
  file.dimension("factor", factors.size());
  file.words("factor", "factor", factors,
             {{"long_name", "spectrum that multiplies light at an interaction"}});
  file.variable("factor_spectrum", {"factor", "traced"}, flat(factor_spectra(simulation)),
                {{"units", "1"}, {"long_name", "spectra as they were traced"}});
  std::vector<long long> lobes;
  for (const Material& material : simulation.materials)
    lobes.push_back(std::count_if(material.lobes.begin(), material.lobes.end(),
                                  [](const SurfaceLobe& lobe) { return !lobe.spectrum.empty(); }));
  file.integers("material_lobes", {"material"}, lobes, {{"long_name", "lobes with a spectrum"}});
  std::vector<std::string> names, types, prefixes;
  std::vector<double> faces;
  for (std::size_t i = 0; i < simulation.sensors.size(); ++i) {
    const Sensor& sensor = *simulation.sensors[i];
    if (sensor.is_image()) continue;
    names.push_back(sensor.name);
    types.push_back(sensor.type);
    prefixes.push_back(simulation.sensors.size() == 1 ? "" : sensor_identifier(simulation, i) + "_");
    const auto normal = sensor.faces(0);
    faces.push_back(sensor.measures() == Measures::irradiance ? (normal ? normal->z() : 0) : std::nan(""));
  }
  file.dimension("recorded", names.size());
  file.words("recorded_sensor", "recorded", names, {{"long_name", "sensors with interaction histograms"}});
  file.words("recorded_type", "recorded", types, {{"long_name", "their kinds"}});
  file.words("recorded_prefix", "recorded", prefixes,
             {{"long_name", "what their variables' names begin with"}});
  file.variable("recorded_faces", {"recorded"}, faces,
                {{"long_name", "z of the normal of a receiver of irradiance; none: a sensor of radiance"}});
  file.global("domain_azimuth", simulation.scene.domain.azimuth_north_clockwise ? "north" : "east");
}

void write_histograms(const SensorResult& result, NetcdfWriter& file, const std::string& prefix,
                      const std::string& view_dimension) {
  std::vector<long long> exponents, first{0};
  std::vector<double> sums;
  std::size_t nodes = 0, kinds = 0, batches = 0;
  for (const InteractionHistogram& view : result.histograms) {
    exponents.insert(exponents.end(), view.exponents.begin(), view.exponents.end());
    sums.insert(sums.end(), view.sums.begin(), view.sums.end());
    nodes += view.nodes();
    first.push_back(static_cast<long long>(nodes));
    if (view.nodes() > 0) kinds = view.sums_per_node, batches = view.batches;
  }
  if (nodes == 0) return;
  file.dimension(prefix + "node", nodes);
  file.dimension(prefix + "kind", kinds);
  file.dimension(prefix + "batch", batches);
  file.dimension(view_dimension + "_edge", first.size());
  file.integers(prefix + "interaction_first", {view_dimension + "_edge"}, first,
                {{"long_name", "first node of each view"}});
  file.integers(prefix + "interaction_exponents", {prefix + "node", "factor"}, exponents,
                {{"long_name", "how often each factor multiplied the light"}});
  file.variable(
      prefix + "interaction_sums", {prefix + "node", prefix + "kind", prefix + "batch"}, sums,
      {{"long_name",
        "mean over the paths of a batch of what no band changes: each sun's light per irradiance / pi, the "
        "sky's per radiance, each sun's of order 1 from the ground"}});
}

Recording read_recording(const std::string& path) {
  const NetcdfReader file(path);
  if (!file.has("factor_spectrum"))
    bad_input({path},
              "there is no interaction histogram: expected a result of bpms simulate --keep-interactions");
  Recording out;
  Simulation& simulation = out.simulation;
  simulation.scene.domain.azimuth_north_clockwise = file.attribute("domain_azimuth") == "north";
  read_light_and_bands(file, simulation);
  read_materials(file, simulation);
  out.seed = std::stoull(file.attribute("seed"));
  out.stopped_by = file.attribute("stopped_by");
  const std::vector<std::string> names = file.words("recorded_sensor"), types = file.words("recorded_type"),
                                 prefixes = file.words("recorded_prefix");
  const std::vector<double> faces = file.numbers("recorded_faces");
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& prefix = prefixes.at(i);
    auto sensor = std::make_unique<RecordedSensor>();
    sensor->name = names[i];
    sensor->type = types.at(i);
    sensor->zeniths_deg = file.numbers(prefix + "vza");
    sensor->azimuths_deg = file.numbers(prefix + "vaa");
    sensor->what = std::isnan(faces.at(i)) ? Measures::radiance : Measures::irradiance;
    sensor->faces_z = std::isnan(faces[i]) ? 0 : faces[i];
    SensorResult& result = out.sensors.emplace_back();
    result.sensor = sensor.get();
    simulation.sensors.push_back(std::move(sensor));
    result.gap = estimates_of(file, prefix + "gap");
    for (const double n : file.numbers(prefix + "samples"))
      result.samples.push_back(static_cast<std::uint64_t>(n));
    if (!simulation.light.suns.empty()) {
      result.sunlit = estimates_of(file, prefix + "fraction_sunlit");
      result.shaded = estimates_of(file, prefix + "fraction_shaded");
      result.lit_behind = estimates_of(file, prefix + "fraction_lit_behind");
      result.sunlit_ground = estimates_of(file, prefix + "bidirectional_gap");
    }
    read_histograms(file, prefix, result);
    if (result.histograms.size() != result.samples.size() || result.samples.size() != result.sensor->views())
      bad_input({path}, "{} views, {} of them with histograms", result.samples.size(),
                result.histograms.size());
  }
  return out;
}

}  // namespace bpms
