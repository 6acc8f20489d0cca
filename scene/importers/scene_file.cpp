// The geometry part of scene.toml: [domain], [ground], [prototypes.X], [[instances]], canopy.
#include <algorithm>
#include <cmath>

#include "core/nearest.h"
#include "core/units.h"
#include "plant/canopy.h"
#include "scene/geometry/assemble.h"
#include "scene/importers/ground.h"
#include "scene/importers/materials.h"
#include "scene/importers/placements.h"
#include "scene/importers/plants.h"
#include "scene/importers/prototype.h"
#include "scene/importers/scene_notes.h"
#include "scene/scene.h"

namespace bpms {
namespace {

constexpr double farthest_m = 1e7;

class SceneReader {
 public:
  SceneReader(const TomlValue& root, const MeshOptions& meshes)
      : root_(root), names_(scene_), meshes_(meshes) {}

  Scene read() {
    names_.define(root_.get("materials"));
    read_canopy_key();
    read_domain(root_.get("domain"));
    read_ground_of_all();
    read_prototypes(root_.get("prototypes"));
    const TomlValue instances = root_.get("instances");
    for (std::size_t i = 0; i < instances.size(); ++i) read_instances(instances[i]);
    if (scene_.instances.empty() && !scene_.ground)
      refuse("an empty scene: there is no [ground], no [[instances]] and no canopy");
    note_unused();
    for (std::uint32_t k = 0; k < scene_.instances.size(); ++k) scene_.instances[k].plant = k;
    resolve_assemblies(assemblies_, scene_);
    note_implausible(scene_);
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
    canopy_domain_ = scene_.domain;
    add_canopy(planted, canopy.where(), names_, scene_, meshes_);
  }

  void read_ground_of_all() {
    const TomlValue table = root_.get("ground");
    const std::optional<Ground> of_canopy = scene_.ground;
    if (of_canopy) check_canopy_ground(canopy_domain_, scene_.domain, root_.get("domain"));
    if (!table) return;
    scene_.ground = read_ground(table, names_, scene_);
    if (of_canopy) check_same_ground(*of_canopy, *scene_.ground, table);
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
    refuse("a periodic domain needs its size: [domain] size_m = [x, y], or boundary = \"open\"",
           domain ? domain : root_);
  }
  [[noreturn]] void refuse(const char* message) const { refuse(message, root_); }
  [[noreturn]] void refuse(const char* message, const TomlValue& at) const {
    for (const char* key :
         {"ground", "prototypes", "instances", "illumination", "sensors", "bands", "sampling"})
      root_.get(key);
    at.reject_choice(message);
  }

  // First what is geometry itself; then what is made of it, in any order.
  void read_prototypes(const TomlValue& prototypes) {
    std::vector<TomlValue> made_of_parts;
    for (const std::string& name : prototypes.keys()) {
      const TomlValue table = prototypes.get(name);
      own_names_.push_back(name);
      if (has_parts(table)) {
        assemblies_.push_back({name, {}});
        made_of_parts.push_back(table);
      } else {
        scene_.prototypes.push_back(read_prototype(name, table, names_, scene_, meshes_));
      }
    }
    used_.assign(scene_.prototypes.size() + assemblies_.size(), false);
    for (std::size_t k = 0; k < made_of_parts.size(); ++k) read_parts(made_of_parts[k], assemblies_[k]);
    const std::vector<std::size_t> cycle = find_cycle(scene_.prototypes.size(), assemblies_);
    if (cycle.empty()) return;
    std::string chain;
    for (const std::size_t k : cycle) chain += (chain.empty() ? "" : " > ") + assemblies_[k].name;
    bad_input(made_of_parts[cycle.front()].get("parts").where(), "prototypes contain each other: {}", chain);
  }

  void read_parts(const TomlValue& table, Assembly& out) {
    const TomlValue parts = table.get("parts");
    if (parts.size() == 0) parts.reject("no parts");
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const std::uint32_t prototype = prototype_number(parts[k].require("prototype"));
      for (Instance& part : read_placements(parts[k], scene_.inputs)) {
        part.prototype = prototype;
        out.parts.push_back(part);
      }
    }
  }

  void read_instances(const TomlValue& table) {
    const std::uint32_t prototype = prototype_number(table.require("prototype"));
    for (Instance& instance : read_placements(table, scene_.inputs)) {
      instance.prototype = prototype;
      scene_.instances.push_back(instance);
    }
  }

  // Assemblies are numbered after the prototypes.
  std::uint32_t prototype_number(const TomlValue& which) {
    const std::string name = which.string();
    std::vector<std::string> known;
    for (const Prototype& prototype : scene_.prototypes) known.push_back(prototype.name);
    for (const Assembly& assembly : assemblies_) known.push_back(assembly.name);
    for (std::size_t i = known.size(); i-- > 0;) {  // the file's own before the canopy's of one name
      if (known[i] != name) continue;
      used_[i] = true;
      return static_cast<std::uint32_t>(i);
    }
    std::reverse(known.begin(), known.end());
    bad_input(which.where(), "there is no [prototypes.{}]{}", name, did_you_mean(name, known));
  }

  void note_unused() {
    for (std::size_t i = 0; i < used_.size(); ++i) {
      const std::string& name = i < scene_.prototypes.size() ? scene_.prototypes[i].name
                                                             : assemblies_[i - scene_.prototypes.size()].name;
      if (!used_[i] && std::find(own_names_.begin(), own_names_.end(), name) != own_names_.end())
        scene_.notes.push_back("[prototypes." + name +
                               "] stands nowhere: no [[instances]] and no parts name it");
    }
  }

  TomlValue root_;
  Scene scene_;
  MaterialNames names_;
  Domain canopy_domain_;
  std::vector<std::string> own_names_;  // of the file's prototypes
  std::vector<Assembly> assemblies_;
  std::vector<bool> used_;
  MeshOptions meshes_;
};

}  // namespace

Scene read_scene_geometry(const TomlDocument& document) {
  return read_scene_geometry(document, traced_plants());
}

Scene read_scene_geometry(const TomlDocument& document, const MeshOptions& meshes) {
  Scene scene = SceneReader(document.root(), meshes).read();
  scene.inputs.insert(scene.inputs.begin(), document.path());
  return scene;
}

}  // namespace bpms
