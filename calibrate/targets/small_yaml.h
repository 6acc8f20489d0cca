// The part of YAML that boards are written in: mappings in block form (KEY: VALUE, one a line, not nested)
// and in flow form ({KEY: VALUE, ...}), lists in flow form ([...]), plain and quoted words, comments.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace bpms {

class SmallYaml {
 public:
  enum class Kind { word, list, map };
  static SmallYaml parse(const std::string& path, std::string_view text);

  Kind kind = Kind::word;
  std::string word;
  std::vector<std::string> keys;  // of a map
  std::vector<SmallYaml> items;   // of a list; of a map: the values in the order of the keys
  SourceLocation where;

  const SmallYaml* find(std::string_view key) const;  // of a map; nullptr when absent
  const SmallYaml& require(std::string_view key) const;
  double number() const;
  long long integer(long long low, long long high) const;
  [[noreturn]] void reject(const std::string& message) const;
};

}  // namespace bpms
