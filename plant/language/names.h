// What a plant text has names for: constants (let), organs made of organs, their parameters.
// A name means something from its definition on; an organ's parameters hide constants of the same name.
#pragma once
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "plant/language/tokens.h"

namespace bpms {

struct NamedConstant {
  double value = 0;
  SourceLocation where;
  std::size_t order = 0;  // among the definitions of constants and organs
};

// organ frond(len, pairs = 3) { WORD BLOCKS }
struct OrganDefinition {
  struct Parameter {
    std::string name;
    std::optional<double> value;  // absent: every use must give one
  };
  SourceLocation where;
  std::size_t order = 0;
  std::vector<Parameter> parameters;
  PlantTokens body;
  std::string unit;  // of the file that it stands in
  bool included = false;
};

using ParameterValues = std::map<std::string, double, std::less<>>;

struct PlantNames {
  std::map<std::string, NamedConstant, std::less<>> constants;
  std::map<std::string, OrganDefinition, std::less<>> organs;
  std::size_t defined = 0;
};

// What can be seen from a place. A definition is checked before it is used, with parameters that have no
// value yet (NaN): what is computed from them is not checked then.
struct Scope {
  const PlantNames& names;
  std::size_t order = std::numeric_limits<std::size_t>::max();  // definitions before this one
  const ParameterValues* parameters = nullptr;
};

bool is_number_function(std::string_view name);  // sqrt, ...
// Refuses a name that the language uses itself.
void require_free_name(std::string_view name, std::string_view of_what, const SourceLocation& where);

// A number, or in its place an expression in parentheses: (2 * len + 1). NaN where it depends on a parameter
// without a value. Operators + - * / ^ and a sign; sqrt, abs, floor, min, max, sin_deg, cos_deg, tan_deg.
double read_number(const PlantTokens& text, std::size_t& at, const Scope& scope, std::string_view what);

}  // namespace bpms
