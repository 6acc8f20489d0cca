// The geometry part of scene.toml: [domain], [ground], [prototypes.X], [[instances]], canopy.
#include <algorithm>
#include <cmath>

#include "core/nearest.h"
#include "core/text.h"
#include "core/units.h"
#include "plant/canopy.h"
#include "scene/importers/disc_list.h"
#include "scene/importers/materials.h"
#include "scene/importers/mesh_file.h"
#include "scene/importers/plants.h"
#include "scene/scene.h"

namespace bpms {
namespace {

constexpr double farthest_m = 1e7;

class SceneReader {
 public:
  explicit SceneReader(const TomlValue& root) : root_(root), names_(scene_) {}

  Scene read() {
    names_.define(root_.get("materials"));
    read_canopy_key();
    read_domain(root_.get("domain"));
    if (const TomlValue ground = root_.get("ground")) read_ground(ground);
    const TomlValue prototypes = root_.get("prototypes");
    for (const std::string& name : prototypes.keys()) read_prototype(name, prototypes.get(name));
    const TomlValue instances = root_.get("instances");
    for (std::size_t i = 0; i < instances.size(); ++i) read_instances(instances[i]);
    note_unused(prototypes.keys());
    return std::move(scene_);
  }

 private:
  void read_canopy_key() {
    const TomlValue canopy = root_.get("canopy");
    if (!canopy) return;
    const std::string path = canopy.file_relative(canopy.string());
    const Canopy planted = read_canopy(path);
    scene_.domain.size_m = planted.size_m;
    scene_.domain.periodic = planted.periodic;
    add_canopy(planted, canopy.where(), names_, scene_);
  }

  void read_domain(const TomlValue& domain) {
    Domain& out = scene_.domain;
    if (const TomlValue size = domain.get("size_m")) {
      const std::vector<double> numbers = size.numbers(2);
      if (!(numbers[0] > 0 && numbers[1] > 0 && std::max(numbers[0], numbers[1]) <= farthest_m))
        size.reject("expected two lengths above 0 and up to 1e7 m");
      out.size_m = {numbers[0], numbers[1]};
    }
    if (const TomlValue boundary = domain.get("boundary"))
      out.periodic = boundary.one_of({"periodic", "open"}) == "periodic";
    if (const TomlValue azimuth = domain.get("azimuth_convention"))
      out.azimuth_north_clockwise =
          azimuth.one_of({"north_clockwise", "east_counterclockwise"}) == "north_clockwise";
    if (out.periodic && !(out.size_m.minCoeff() > 0)) no_size(domain);
  }

  // A misspelt `canopy` or `domain` is the likelier mistake.
  [[noreturn]] void no_size(const TomlValue& domain) const {
    for (const char* key :
         {"ground", "prototypes", "instances", "illumination", "sensors", "bands", "sampling"})
      root_.get(key);
    (domain ? domain : root_)
        .reject_choice("a periodic domain needs its size: [domain] size_m = [x, y], or boundary = \"open\"");
  }

  void read_ground(const TomlValue& ground) {
    const TomlValue type = ground.require("type");
    if (type.one_of({"plane", "dem"}) == "dem") type.reject("terrain is not built yet; a plane is");
    Ground out;
    if (const TomlValue height = ground.get("height_m"))
      out.height_m = height.number(-farthest_m, farthest_m);
    const TomlValue material = ground.require("material");
    out.material = names_.number(material.string(), material.where());
    scene_.ground = out;
  }

  void read_prototype(const std::string& name, const TomlValue& table) {
    static const std::vector<std::string> later{"canopy", "librat", "volume"};
    for (const std::string& key : later)
      if (const TomlValue value = table.get(key)) value.reject("prototypes of this kind are not built yet");
    const TomlValue discs = table.get("discs"), plant = table.get("plant"), mesh = table.get("mesh");
    if (static_cast<int>(static_cast<bool>(discs)) + static_cast<bool>(plant) + static_cast<bool>(mesh) != 1)
      bad_input(table.where(), "[{}] needs one of discs, plant, mesh", table.name());
    const TomlValue material = table.get("material"), materials = table.get("materials");
    const std::string all = material ? material.string() : "";
    const SourceLocation where = material ? material.where() : table.where();
    const TomlValue* renamed = materials ? &materials : nullptr;
    Prototype out;
    if (discs) {
      const std::string path = input(discs);
      if (materials) materials.reject("discs have one material: give `material`");
      if (!material) bad_input(table.where(), "[{}] needs material = \"...\"", table.name());
      out.disc_material = names_.number(all, where);
      out.discs = read_disc_list(path);
    } else if (plant) {
      const Plant read = read_plant(input(plant));
      scene_.notes.insert(scene_.notes.end(), read.warnings.begin(), read.warnings.end());
      out = plant_prototype(read, name, all, renamed, where, names_);
    } else {
      const TomlValue unit = table.get("unit"), up = table.get("up");
      const double metres = unit ? metres_per_unit(unit.string(), unit.where()) : 1;
      const bool y_up = up && up.one_of({"z", "y"}) == "y";
      out.mesh = read_mesh_file(input(mesh), metres, y_up);
      out.material_of_organ = organ_materials(*out.mesh, all, renamed, where, names_);
    }
    out.name = name;
    scene_.prototypes.push_back(std::move(out));
  }

  void read_instances(const TomlValue& table) {
    const TomlValue which = table.require("prototype");
    Instance instance;
    instance.prototype = prototype_number(which);
    if (const TomlValue scale = table.get("scale")) {
      constexpr double largest_scale = 1e6;
      instance.scale = scale.positive();
      if (instance.scale > largest_scale) scale.reject("expected a factor up to 1e6");
    }
    const double turn = radians(table.number_or("rotation_deg", 0));
    const TomlValue positions = table.require("positions");
    const auto place = [&](const std::vector<double>& row) {
      instance.position_m = {row[0], row[1], row[2]};
      instance.rotation = turn + (row.size() > 3 ? radians(row[3]) : 0);
      scene_.instances.push_back(instance);
    };
    if (positions.is_string()) {
      const NumberTable table_of = read_number_table(input(positions), 3, 4, "x y z [rotation_deg]");
      for (std::size_t i = 0; i < table_of.rows.size(); ++i) {
        if (too_far(table_of.rows[i]))
          bad_input({table_of.file, table_of.lines[i]}, "a position beyond 1e7 m");
        place(table_of.rows[i]);
      }
      return;
    }
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const std::vector<double> row = positions[i].numbers();
      if (row.size() < 3 || row.size() > 4 || too_far(row))
        positions[i].reject("expected [x, y, z] or [x, y, z, rotation_deg], positions within 1e7 m");
      place(row);
    }
    if (positions.size() == 0) positions.reject("no positions");
  }

  static bool too_far(const std::vector<double>& row) {
    return std::any_of(row.begin(), row.begin() + 3, [](double x) { return std::abs(x) > farthest_m; });
  }

  std::uint32_t prototype_number(const TomlValue& which) const {
    const std::string name = which.string();
    std::vector<std::string> known;
    for (std::size_t i = scene_.prototypes.size();
         i-- > 0;) {  // the file's own before the canopy's of one name
      if (scene_.prototypes[i].name == name) return static_cast<std::uint32_t>(i);
      known.push_back(scene_.prototypes[i].name);
    }
    bad_input(which.where(), "there is no [prototypes.{}]{}", name, did_you_mean(name, known));
  }

  void note_unused(const std::vector<std::string>& names) {
    for (std::uint32_t i = 0; i < scene_.prototypes.size(); ++i) {
      const std::string& name = scene_.prototypes[i].name;
      const bool used = std::any_of(scene_.instances.begin(), scene_.instances.end(),
                                    [i](const Instance& instance) { return instance.prototype == i; });
      if (!used && std::find(names.begin(), names.end(), name) != names.end())
        scene_.notes.push_back("[prototypes." + name + "] stands nowhere: no [[instances]] names it");
    }
  }

  std::string input(const TomlValue& path) {
    scene_.inputs.push_back(path.file_relative(path.string()));
    return scene_.inputs.back();
  }

  TomlValue root_;
  Scene scene_;
  MaterialNames names_;
};

}  // namespace

Scene read_scene_geometry(const TomlDocument& document) {
  Scene scene = SceneReader(document.root()).read();
  scene.inputs.insert(scene.inputs.begin(), document.path());
  return scene;
}

}  // namespace bpms
