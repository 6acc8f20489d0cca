// The literals that mrcal's files are written in: dictionaries, lists, numbers, texts of Python, '#'
// comments.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace bpms {

struct PythonLiteral {
  enum class Kind { none, truth, number, text, bytes, list, dictionary };
  Kind kind = Kind::none;
  double number = 0;                 // 0 or 1 of a truth
  std::string text;                  // bytes are passed over and stay empty
  std::vector<PythonLiteral> items;  // of a list, or the values of a dictionary
  std::vector<std::string> keys;
  SourceLocation where;

  const PythonLiteral* find(std::string_view key) const;
  std::vector<double> numbers(const char* what) const;  // of a list of finite numbers, or located bad_input
};
PythonLiteral parse_python_literal(const std::string& path, std::string_view text);

}  // namespace bpms
