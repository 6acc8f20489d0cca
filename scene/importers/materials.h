// Material names as geometry uses them, numbered in order of first use.
#pragma once
#include <string>
#include <vector>

#include "core/toml.h"
#include "scene/scene.h"

namespace bpms {

class MaterialNames {
 public:
  explicit MaterialNames(Scene& scene) : scene_(scene) {}
  // Names are then checked against the keys of this table ([materials] of scene.toml).
  void define(const TomlValue& materials);
  // The number of the name; one that is not defined is bad_input at `where`.
  std::uint32_t number(const std::string& name, const SourceLocation& where);
  bool defined(const std::string& name) const;

 private:
  Scene& scene_;
  bool check_ = false;
  std::vector<std::string> defined_;
};

// The materials of a mesh's organs: as the table `renamed` (may be null) maps the mesh's names, else `all`,
// else, when that is empty, the names as they are. A key of the table that the mesh does not use is
// bad_input.
std::vector<std::uint32_t> organ_materials(const Mesh& mesh, const std::string& all, const TomlValue* renamed,
                                           const SourceLocation& where, MaterialNames& names);

}  // namespace bpms
