#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "simulate/output/derived.h"
#include "simulate/output/flux_output.h"
#include "simulate/output/netcdf.h"
#include "simulate/output/output.h"
#include "simulate/output/quantity.h"
#include "simulate/output/recording.h"

namespace bpms {
namespace {

// Writes the variables of one sensor.
class SensorVariables {
 public:
  SensorVariables(const Simulation& simulation, const Result& whole, std::size_t sensor_number,
                  NetcdfWriter& file, std::string prefix, const NetcdfOptions& options)
      : simulation_(simulation),
        whole_(whole),
        number_(sensor_number),
        result_(whole.sensors[sensor_number]),
        file_(file),
        prefix_(std::move(prefix)),
        bands_(simulation.bands.written()),
        by_origin_(!result_.sensor->is_image() || options.image_origins) {
    const Sensor& sensor = *result_.sensor;
    if (sensor.is_image()) {
      views_ = {prefix_ + "y", prefix_ + "x"};
      file_.dimension(views_[0], static_cast<std::size_t>(sensor.height()));
      file_.dimension(views_[1], static_cast<std::size_t>(sensor.width()));
    } else {
      views_ = {prefix_ + "view"};
      file_.dimension(views_[0], sensor.views());
    }
  }

  void write() {
    if (!result_.sensor->is_image()) write_angles();
    for (const bool reflectance : {true, false}) {
      if (reflectance && result_.sensor->is_image()) continue;
      write_totals(reflectance);
      write_axis(reflectance, "component", components(), parts_of_components());
      write_orders(reflectance);
    }
    write_fractions();
    if (!result_.sensor->is_image()) write_derived();
    std::vector<long long> samples(result_.samples.begin(), result_.samples.end());
    file_.integers(prefix_ + "samples", views_, samples, {{"long_name", "paths traced"}});
    write_covariance();
    if (!result_.histograms.empty()) write_histograms(result_, file_, prefix_, views_[0]);
    if (!result_.truncation.empty())
      file_.variable(
          prefix_ + "truncation_bias", with(views_, "band"), result_.truncation,
          {{"units", "W m-2 sr-1 um-1"},
           {"long_name",
            "radiance above max_order left out, estimated from the decay of the last two orders"}});
  }

 private:
  using Words = std::vector<std::string>;
  static Words with(Words to, const std::string& more) {
    to.push_back(more);
    return to;
  }
  Origin main_origin() const {
    return !simulation_.light.suns.empty() && simulation_.light.sky ? Origin::direct : Origin::total;
  }

  void write_angles() {
    std::vector<double> vza, vaa, sza, saa;
    const Sun* sun = sun_of(simulation_.light);
    for (std::size_t view = 0; view < result_.sensor->views(); ++view) {
      vza.push_back(result_.sensor->vza_deg(view));
      vaa.push_back(result_.sensor->vaa_deg(view));
    }
    const auto put = [&](const std::string& name, const std::vector<double>& values, const std::string& what,
                         const std::string& standard) {
      file_.variable(prefix_ + name, views_, values,
                     {{"units", "degree"}, {"long_name", what}, {"standard_name", standard}});
    };
    put("vza", vza, "view zenith angle, towards the sensor; signed in a plane, negative on the sun's side",
        "sensor_zenith_angle");
    put("vaa", vaa, "view azimuth angle, towards the sensor", "sensor_azimuth_angle");
    if (!prefix_.empty()) return;
    sza.assign(vza.size(), sun ? sun->zenith_deg : no_value);
    saa.assign(vza.size(), sun ? sun->azimuth_deg : no_value);
    put("sza", sza, "sun zenith angle, towards the sun", "solar_zenith_angle");
    put("saa", saa, "sun azimuth angle, towards the sun", "solar_azimuth_angle");
  }

  // One part as it is written: per view and band, NaN where nothing was traced.
  void fill(std::size_t part, bool reflectance, std::vector<double>& value, std::vector<double>& error,
            std::size_t offset, std::size_t stride) const {
    const std::vector<double> scale =
        reflectance ? reflectance_scale(simulation_, result_.parts[part].origin, result_.parts[part].sun)
                    : std::vector<double>(bands_, light_scale(*result_.sensor));
    for (std::size_t view = 0; view < result_.samples.size(); ++view) {
      for (std::size_t band = 0; band < bands_; ++band) {
        const std::size_t from = view * bands_ + band, to = from * stride + offset;
        const bool known = result_.samples[view] > 0;
        value[to] = known ? result_.radiance[part].value[from] * scale[band] : no_value;
        error[to] = known ? result_.radiance[part].standard_error[from] * scale[band] : no_value;
      }
    }
  }

  void put(const std::string& name, const Words& dimensions, const std::vector<double>& value,
           const std::vector<double>& error, const std::string& what, const std::string& units) {
    Words coordinates = {"wavelength", prefix_ + "vza", prefix_ + "vaa"};
    if (std::find(dimensions.begin(), dimensions.end(), "sun") != dimensions.end())
      coordinates.insert(coordinates.end(), {"sun_zenith", "sun_azimuth"});
    std::string list;
    if (!result_.sensor->is_image())
      for (const std::string& word : coordinates) list += (list.empty() ? "" : " ") + word;
    NetcdfAttributes attributes{
        {"units", units}, {"long_name", what}, {"ancillary_variables", prefix_ + name + "_se"}};
    NetcdfAttributes of_error{{"units", units}, {"long_name", "standard error of " + what}};
    if (!list.empty()) {
      attributes.emplace_back("coordinates", list);
      of_error.emplace_back("coordinates", list);
    }
    put_pair(name, dimensions, {value, error}, attributes, of_error);
  }
  void put_pair(const std::string& name, const Words& dimensions, const Estimates& of,
                const NetcdfAttributes& attributes, const NetcdfAttributes& of_error) {
    const bool image = result_.sensor->is_image();
    file_.variable(prefix_ + name, dimensions, of.value, attributes,
                   image ? Precision::single : Precision::full);
    file_.variable(prefix_ + name + "_se", dimensions, of.standard_error, of_error,
                   image ? Precision::three_digits : Precision::full);
  }

  Quantity quantity(bool reflectance) const {
    return reflectance ? reflectance_quantity(simulation_.light, *result_.sensor)
                       : light_quantity(*result_.sensor);
  }

  void write_parts(bool reflectance, const std::string& suffix, const std::string& axis,
                   const std::vector<std::size_t>& parts, const std::string& what) {
    if (parts.empty()) return;
    const std::size_t count = result_.samples.size() * bands_;
    const std::size_t stride = axis.empty() ? 1 : parts.size();
    std::vector<double> value(count * stride), error(count * stride);
    for (std::size_t i = 0; i < parts.size(); ++i) fill(parts[i], reflectance, value, error, i, stride);
    Words dimensions = with(views_, "band");
    if (!axis.empty()) dimensions.push_back(axis);
    const Quantity what_it_is = quantity(reflectance);
    put(what_it_is.name + suffix, dimensions, value, error, what_it_is.words + what, what_it_is.units);
  }

  void write_totals(bool reflectance) {
    write_parts(reflectance, "", "", {0}, "");
    std::vector<std::size_t> by_origin = parts_with(result_, Origin::total, Component::all, false);
    for (const Origin origin : {Origin::direct, Origin::diffuse})
      for (const std::size_t p : parts_with(result_, origin, Component::all, false)) by_origin.push_back(p);
    if (by_origin.size() > 1 && by_origin_)
      write_parts(reflectance, "_by_origin", "origin", by_origin, " by origin of the light");
    std::vector<std::size_t> by_sun;
    for (std::size_t p = 0; p < result_.parts.size(); ++p) {
      const Part& part = result_.parts[p];
      if (part.sun != every_sun && part.component == Component::all && part.order == every_order)
        by_sun.push_back(p);
    }
    if (by_origin_) write_parts(reflectance, "_by_sun", "sun", by_sun, " of the light of each sun");
  }
  static Words components() { return {"uc_sgl", "co_sgl", "mlt"}; }
  std::vector<std::size_t> parts_of_components() const {
    std::vector<std::size_t> out;
    for (const Component c : {Component::uc_sgl, Component::co_sgl, Component::mlt})
      for (const std::size_t p : parts_with(result_, main_origin(), c, false)) out.push_back(p);
    return out;
  }
  void write_axis(bool reflectance, const std::string& axis, const Words& names,
                  const std::vector<std::size_t>& parts) {
    if (parts.size() == names.size())
      write_parts(reflectance, "_by_" + axis, axis, parts, " of direct light by " + axis);
  }
  void write_orders(bool reflectance) {
    write_parts(reflectance, "_by_order", prefix_ + "order", define_orders(), " by scattering order");
    for (const Origin origin : {Origin::direct, Origin::diffuse})
      write_parts(reflectance, std::string("_") + name_of(origin) + "_by_order", prefix_ + "order",
                  parts_with(result_, origin, Component::all, true),
                  std::string(" of ") + name_of(origin) + " light by scattering order");
  }
  std::vector<std::size_t> define_orders() {
    const std::vector<std::size_t> parts = parts_with(result_, Origin::total, Component::all, true);
    if (parts.empty() || orders_defined_) return parts;
    orders_defined_ = true;
    std::vector<double> orders;
    for (const std::size_t p : parts) orders.push_back(result_.parts[p].order);
    file_.dimension(prefix_ + "order", orders.size());
    file_.variable(
        prefix_ + "order", {prefix_ + "order"}, orders,
        {{"long_name", "scattering order (interactions with matter); the last holds all higher ones"},
         {"units", "1"}});
    return parts;
  }

  // Of the totals as radiance, where views share paths.
  void write_covariance() {
    if (result_.covariance.empty()) return;
    const std::string other = views_[0] + "_other";
    file_.dimension(other, result_.sensor->views());
    file_.variable(prefix_ + "covariance", {"band", views_[0], other}, result_.covariance,
                   {{"units", "(" + std::string(light_quantity(*result_.sensor).units) + ")2"},
                    {"long_name", "covariance of the radiance of views, which share paths"}});
  }

  void write_fractions() {
    const auto put_fraction = [&](const std::string& name, const Words& dimensions, const Estimates& of,
                                  const std::string& what) {
      std::vector<double> value = of.value, error = of.standard_error;
      const std::size_t each = value.size() / std::max<std::size_t>(1, result_.samples.size());
      for (std::size_t i = 0; i < value.size(); ++i)
        if (result_.samples[i / each] == 0) value[i] = error[i] = no_value;
      put_pair(name, dimensions, {value, error},
               {{"units", "1"}, {"long_name", what}, {"ancillary_variables", prefix_ + name + "_se"}},
               {{"units", "1"}, {"long_name", "standard error of " + what}});
    };
    put_fraction("gap", views_, result_.gap, "fraction of view that meets no canopy");
    if (simulation_.light.suns.empty()) return;
    const Words by_sun = simulation_.light.suns.size() > 1 ? with(views_, "sun") : views_;
    put_fraction("bidirectional_gap", by_sun, result_.sunlit_ground,
                 "fraction of view that is sunlit ground");
    if (simulation_.materials.empty()) return;
    put_fraction("fraction_sunlit", with(by_sun, "material"), result_.sunlit,
                 "fraction of view that is sunlit, by material met first");
    put_fraction("fraction_shaded", with(by_sun, "material"), result_.shaded,
                 "fraction of view that is shaded, by material met first");
    put_fraction("fraction_lit_behind", with(by_sun, "material"), result_.lit_behind,
                 "fraction of view that is sunlit on the face that is not seen, by material met first");
  }

  void write_derived() {
    const auto put_derived = [&](const std::string& name, const Words& dimensions, const Estimates& of,
                                 const std::string& what) {
      if (!of.value.empty()) put(name, dimensions, of.value, of.standard_error, what, "1");
    };
    const Words by_sun = simulation_.light.suns.size() > 1 ? with(views_, "sun") : views_;
    put_derived("overlap", by_sun, overlap_function(simulation_, whole_, number_),
                "overlap function P(s,v) - P(s) P(v)");
    put_derived("effective_g", views_, effective_g(simulation_, whole_, number_),
                "effective projection of intercepting area towards the sensor, from the gap fraction");
    put_derived("effective_gamma", with(by_sun, "band"), effective_gamma(simulation_, whole_, number_),
                "effective area scattering phase function, of a turbid medium with the same gaps");
    if (!whole_.diffuse_fraction.empty())
      put_derived(recombined_name(simulation_.light, *result_.sensor), with(views_, "band"),
                  recombined_reflectance(simulation_, result_, whole_.diffuse_fraction),
                  std::string(quantity(true).words) + " at the diffuse fraction asked for");
  }

  const Simulation& simulation_;
  const Result& whole_;
  std::size_t number_;
  const SensorResult& result_;
  NetcdfWriter& file_;
  std::string prefix_;
  std::size_t bands_;
  bool by_origin_;
  Words views_;
  bool orders_defined_ = false;
};

void write_globals(NetcdfWriter& file, const Simulation& simulation, const Result& result,
                   const Provenance& provenance) {
  file.global("Conventions", "CF-1.8");
  file.global("title", "radiance simulated by bpms");
  file.global("source", "bpms " + version());
  file.global("version", version());
  file.global("command", provenance.command);
  file.global("history", provenance.command);
  file.global("seed", std::to_string(result.seed));
  std::string inputs;
  for (const auto& input : provenance.inputs)
    inputs += (inputs.empty() ? "" : "\n") + input.sha256 + "  " + input.path;
  file.global("inputs_sha256", inputs);
  file.global("stopped_by", result.stopped_by);
  file.global("complete", result.stopped_by == "interrupt" ? "no: interrupted" : "yes");
  file.global("azimuth_convention", simulation.scene.domain.azimuth_north_clockwise
                                        ? "clockwise from north (y)"
                                        : "counter-clockwise from east (x)");
  file.global("angle_convention",
              "zenith and azimuth from the target: sza, saa towards the sun, vza, vaa towards the sensor; in "
              "a plane vza is "
              "negative on the sun's side");
  file.global("standard_error", "one standard deviation, from 32 independent scrambles");
}

void write_suns(NetcdfWriter& file, const Light& light) {
  std::vector<std::string> names;
  std::vector<double> zenith, azimuth;
  for (const Sun& sun : light.suns) {
    names.push_back(sun.name);
    zenith.push_back(sun.zenith_deg);
    azimuth.push_back(sun.azimuth_deg);
  }
  file.dimension("sun", names.size());
  file.words("sun", "sun", names, {{"long_name", "sun"}});
  file.variable(
      "sun_zenith", {"sun"}, zenith,
      {{"units", "degree"}, {"standard_name", "solar_zenith_angle"}, {"long_name", "sun zenith angle"}});
  file.variable(
      "sun_azimuth", {"sun"}, azimuth,
      {{"units", "degree"}, {"standard_name", "solar_azimuth_angle"}, {"long_name", "sun azimuth angle"}});
}

// Gaps towards the suns, and the diffuse fraction that was asked for.
void write_common_derived(NetcdfWriter& file, const Simulation& simulation, const Result& result) {
  const std::vector<std::string> by_sun =
      simulation.light.suns.size() > 1 ? std::vector<std::string>{"sun"} : std::vector<std::string>{};
  const auto put = [&](const std::string& name, const Estimates& of, const std::string& what) {
    if (of.value.empty()) return;
    file.variable(name, by_sun, of.value,
                  {{"units", "1"}, {"long_name", what}, {"ancillary_variables", name + "_se"}});
    file.variable(name + "_se", by_sun, of.standard_error,
                  {{"units", "1"}, {"long_name", "standard error of " + what}});
  };
  put("sun_gap", result.sun_gap, "gap probability towards the sun");
  put("sun_effective_g", effective_g_of_suns(simulation, result),
      "effective projection of intercepting area towards the sun, from the gap probability");
  if (!result.diffuse_fraction.empty())
    file.variable("diffuse_fraction", {"band"}, result.diffuse_fraction,
                  {{"units", "1"}, {"long_name", "diffuse fraction of the irradiance that was asked for"}});
}

}  // namespace

std::string sensor_identifier(const Simulation& simulation, std::size_t sensor) {
  std::set<std::string> taken;
  for (std::size_t i = 0;; ++i) {
    std::string name = simulation.sensors[i]->name;
    for (char& c : name)
      if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    const std::string plain = name;
    for (std::size_t number = i + 1; !taken.insert(name).second; ++number)
      name = plain + "_" + std::to_string(number);
    if (i == sensor) return name;
  }
}

void write_netcdf(const Simulation& simulation, const Result& result, const Provenance& provenance,
                  const std::string& path, const NetcdfOptions& options) {
  NetcdfWriter file(path, options.overwrite);
  write_globals(file, simulation, result, provenance);
  std::vector<double> nm;
  std::vector<std::string> names;
  for (std::size_t band = 0; band < simulation.bands.written(); ++band) {
    nm.push_back(simulation.bands.written_nm(band));
    names.push_back(simulation.bands.written_name(band));
  }
  file.dimension("band", nm.size());
  if (!simulation.bands.responses.empty())
    file.words("band", "band", names, {{"long_name", "band of the sensor"}});
  file.variable("wavelength", {"band"}, nm,
                {{"units", "nm"}, {"long_name", "wavelength"}, {"standard_name", "radiation_wavelength"}});
  if (!simulation.light.suns.empty() && simulation.light.sky) {
    file.dimension("origin", 3);
    file.words("origin", "origin", {"total", "direct", "diffuse"},
               {{"long_name", "source that the light came from"}});
  }
  if (simulation.light.suns.size() > 1) write_suns(file, simulation.light);
  if (!simulation.light.suns.empty()) {
    file.dimension("component", 3);
    file.words("component", "component", {"uc_sgl", "co_sgl", "mlt"},
               {{"long_name", "single scattering by the ground, by the canopy; multiple scattering"}});
  }
  if (!simulation.materials.empty()) {
    std::vector<std::string> materials;
    for (const Material& material : simulation.materials) materials.push_back(material.name);
    file.dimension("material", materials.size());
    file.words("material", "material", materials, {{"long_name", "material"}});
  }
  write_common_derived(file, simulation, result);
  if (std::any_of(result.sensors.begin(), result.sensors.end(),
                  [](const SensorResult& sensor) { return !sensor.histograms.empty(); }))
    write_recording(simulation, file);
  for (std::size_t i = 0; i < result.sensors.size(); ++i) {
    const std::string prefix = simulation.sensors.size() == 1 ? "" : sensor_identifier(simulation, i) + "_";
    SensorVariables(simulation, result, i, file, prefix, options).write();
  }
  for (std::size_t f = 0; f < result.fluxes.size(); ++f) {
    std::string prefix = simulation.fluxes[f].name + "_";
    for (char& c : prefix)
      if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    if (simulation.sensors.empty() && result.fluxes.size() == 1) prefix.clear();
    write_fluxes(simulation, *result.fluxes[f], file, prefix);
  }
  file.commit();
}

}  // namespace bpms
