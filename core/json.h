// Reports are JSON documents whose keys keep their order; a number that is not finite is written as null.
#pragma once
#include <cmath>
#include <nlohmann/json.hpp>

namespace bpms {
using Json = nlohmann::ordered_json;

inline Json json_number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}
}  // namespace bpms
