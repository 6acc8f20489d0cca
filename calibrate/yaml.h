// YAML documents whose values know their line and column; yaml-cpp stays behind this header.
#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace YAML {
class Node;
}

namespace bpms {

class YamlValue {
 public:
  static YamlValue parse(const std::string& path, const std::string& text);

  explicit operator bool() const { return node_ != nullptr; }
  SourceLocation where() const;
  const std::string& name() const { return name_; }  // "cam0.intrinsics"

  bool is_table() const, is_list() const;
  std::vector<std::string> keys() const;  // of a table, in order
  YamlValue get(const std::string& key) const;
  YamlValue require(const std::string& key) const;  // or located bad_input
  std::size_t size() const;
  YamlValue operator[](std::size_t index) const;

  std::string string() const;
  double number() const;  // finite and at most 1e12
  long long integer(long long low, long long high) const;
  std::vector<double> numbers() const;
  std::vector<double> numbers(std::size_t size) const;
  [[noreturn]] void reject(const std::string& message) const;

 private:
  std::shared_ptr<const YAML::Node> node_;
  std::string path_, name_;
};

// In quotes, escaped.
std::string yaml_string(std::string_view text);

}  // namespace bpms
