#include "scene/importers/materials.h"

#include <algorithm>

#include "core/nearest.h"

namespace bpms {

void MaterialNames::define(const TomlValue& materials) {
  check_ = true;
  defined_ = materials.keys();
}

bool MaterialNames::defined(const std::string& name) const {
  return !check_ || std::find(defined_.begin(), defined_.end(), name) != defined_.end();
}

std::uint32_t MaterialNames::number(const std::string& name, const SourceLocation& where) {
  if (!defined(name)) bad_input(where, "there is no [materials.{}]{}", name, did_you_mean(name, defined_));
  const auto found = std::find(scene_.materials.begin(), scene_.materials.end(), name);
  if (found == scene_.materials.end()) {
    scene_.materials.push_back(name);
    return static_cast<std::uint32_t>(scene_.materials.size() - 1);
  }
  return static_cast<std::uint32_t>(found - scene_.materials.begin());
}

std::vector<std::uint32_t> organ_materials(const Mesh& mesh, const std::string& all, const TomlValue* renamed,
                                           const SourceLocation& where, MaterialNames& names) {
  std::vector<std::string> own;
  for (const Mesh::Organ& organ : mesh.organs) own.push_back(organ.material);
  for (const std::string& key : renamed != nullptr ? renamed->keys() : std::vector<std::string>{}) {
    if (std::find(own.begin(), own.end(), key) == own.end()) {
      std::sort(own.begin(), own.end());
      own.erase(std::unique(own.begin(), own.end()), own.end());
      bad_input(renamed->get(key).where(), "nothing here is of material {}{}", in_quotes(key),
                did_you_mean(key, own));
    }
  }
  std::vector<std::uint32_t> out;
  for (const std::string& name : own) {
    if (renamed != nullptr && renamed->has(name)) {
      const TomlValue value = renamed->get(name);
      out.push_back(names.number(value.string(), value.where()));
    } else if (!all.empty()) {
      out.push_back(names.number(all, where));
    } else if (name.empty()) {
      bad_input(where, "parts without a material's name; give `material`");
    } else {
      out.push_back(names.number(name, where));
    }
  }
  return out;
}

}  // namespace bpms
