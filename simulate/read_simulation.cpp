#include <algorithm>

#include "core/text.h"
#include "core/units.h"
#include "simulate/forward/choose_mode.h"
#include "simulate/simulate.h"

namespace bpms {
namespace {

constexpr double most_samples = 1e11;

std::uint64_t count_of(const TomlValue& value) {
  return static_cast<std::uint64_t>(value.integer(1, static_cast<long long>(most_samples)));
}

Sampling read_sampling(const TomlValue& table) {
  Sampling out;
  const TomlValue target = table.get("target_se");
  const TomlValue samples = table.get("samples");
  for (const char* other : {"max_samples", "max_seconds", "max_order", "orders", "roulette", "share_paths",
                            "diffuse_rays", "normals", "shadow", "mode"})
    table.get(other);
  if (static_cast<bool>(target) == static_cast<bool>(samples))
    table.reject_choice("expected one of target_se and samples");
  if (target)
    set_target_se(out, target.is_string() ? target.string() : fmt::format("{}", target.number()),
                  target.where());
  if (samples) out.samples = count_of(samples);
  if (const TomlValue most = table.get("max_samples")) out.max_samples = count_of(most);
  if (const TomlValue most = table.get("max_seconds")) out.max_seconds = most.positive();
  if (const TomlValue order = table.get("max_order"))
    out.max_order = static_cast<int>(order.integer(0, 100000));
  if (const TomlValue orders = table.get("orders")) out.orders = static_cast<int>(orders.integer(1, 1000));
  out.roulette = table.boolean_or("roulette", true);
  constexpr int most_branches = 255;
  if (const TomlValue rays = table.get("diffuse_rays"))
    out.diffuse_rays = static_cast<int>(rays.integer(1, most_branches));
  if (const TomlValue normals = table.get("normals"))
    out.interpolated_normals = normals.one_of({"geometric", "interpolated"}) == "interpolated";
  if (const TomlValue shadow = table.get("shadow"))
    out.attenuate_shadows = shadow.one_of({"block", "attenuate"}) == "attenuate";
  const TomlValue share = table.get("share_paths"), mode = table.get("mode");
  if (mode) {
    out.mode = read_mode(mode);
    out.mode_where = mode.where();
  }
  if (share && share.boolean()) {
    if (mode && out.mode == Mode::reverse)
      share.reject("views share paths in forward mode: expected mode = \"auto\"");
    if (!mode) out.mode = Mode::forward;
    out.mode_where = share.where();
  }
  return out;
}

// In the order of scene.materials. The materials of maps come after those that geometry names.
std::vector<Material> read_materials(const TomlValue& table, Scene& scene, const Bands& bands,
                                     std::vector<std::string>& inputs) {
  MaterialContext context(table, bands, inputs);
  if (table)
    for (const std::string& name : table.keys()) context.material(name, table.require(name));
  std::vector<Material> out;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const std::string name = scene.materials[i];
    if (!context.has(name)) table.reject(fmt::format("no [materials.{}], which the geometry uses", name));
    out.push_back(context.material(name, table));
    scene.notes.insert(scene.notes.end(), out.back().notes.begin(), out.back().notes.end());
    for (const std::string& part : out.back().map_materials)
      if (std::find(scene.materials.begin(), scene.materials.end(), part) == scene.materials.end())
        scene.materials.push_back(part);
  }
  return out;
}

}  // namespace

void set_target_se(Sampling& sampling, const std::string& text, const SourceLocation& where) {
  const bool percent = text.ends_with('%');
  const auto number = parse_number(percent ? text.substr(0, text.size() - 1) : text);
  if (!number || !(*number > 0))
    bad_input(where, "target_se is {}: expected a number above 0, or a percentage such as \"0.1%\"",
              in_quotes(text));
  sampling.target_se = percent ? *number / 100.0 : *number;
  sampling.relative = percent;
  sampling.samples = 0;
}

Simulation read_simulation(const std::string& path) {
  return parse_simulation(path, read_text(path));
}

Simulation parse_simulation(const std::string& path, std::string_view text) {
  const TomlDocument document = TomlDocument::parse(path, text);
  const TomlValue root = document.root();
  Simulation out;
  out.scene = read_scene_geometry(document);
  out.inputs = out.scene.inputs;
  out.bands = read_bands(root.get("bands"), out.inputs);
  out.materials = read_materials(root.get("materials"), out.scene, out.bands, out.inputs);
  out.light =
      read_light(root.require("illumination"), out.scene.domain, out.bands, out.inputs, out.scene.notes);
  const TomlValue sensors = root.require("sensors");
  if (!sensors.is_array() || sensors.size() == 0) sensors.reject("expected at least one [[sensors]]");
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const TomlValue type = sensors[i].get("type");
    if (type && type.is_string() && type.string() == "flux") {
      const TomlValue name = sensors[i].require("name");
      for (const FluxSensor& other : out.fluxes)
        if (other.name == name.string()) name.reject(fmt::format("a second sensor named \"{}\"", other.name));
      out.fluxes.push_back({name.string(), read_flux_options(sensors[i])});
      continue;
    }
    for (auto& sensor : read_sensors(sensors[i], {out.scene, out.light, out.inputs, out.scene.notes})) {
      for (const auto& other : out.sensors)
        if (other->name == sensor->name)
          sensors[i].require("name").reject(fmt::format("a second sensor named \"{}\"", sensor->name));
      out.sensors.push_back(std::move(sensor));
    }
  }
  out.sampling = read_sampling(root.require("sampling"));
  if (const TomlValue limits = root.get("limits"))
    if (const TomlValue memory = limits.get("memory"))
      out.most_bytes = parse_bytes(memory.string(), memory.where());
  document.finish();
  return out;
}

}  // namespace bpms
