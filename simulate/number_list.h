// A list of numbers as scenes write it: one number, an array, or { from = a, to = b, step = c } with both
// ends in.
#pragma once
#include <functional>
#include <vector>

#include "core/toml.h"

namespace bpms {
// `read` takes one number from its value and rejects what is out of range.
std::vector<double> read_number_list(const TomlValue& value,
                                     const std::function<double(const TomlValue&)>& read);
}  // namespace bpms
