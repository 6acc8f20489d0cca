#include "simulate/number_list.h"

#include <cmath>

namespace bpms {

std::vector<double> read_number_list(const TomlValue& value,
                                     const std::function<double(const TomlValue&)>& read) {
  std::vector<double> out;
  if (value.is_table()) {
    const double from = read(value.require("from"));
    const double to = read(value.require("to"));
    const double step = value.require("step").positive();
    if (to < from) value.require("to").reject(fmt::format("{} lies before from = {}", to, from));
    constexpr double most = 100000;
    if ((to - from) / step > most) value.require("step").reject("expected at most 100 000 numbers");
    constexpr double rounding = 1e-9;  // 0.3 / 0.1 is a little less than 3
    const auto count = static_cast<std::size_t>(std::floor((to - from) / step + rounding)) + 1;
    for (std::size_t i = 0; i < count; ++i) out.push_back(from + static_cast<double>(i) * step);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) out.push_back(read(value[i]));
    if (out.empty()) value.reject("expected at least one number");
  } else {
    out.push_back(read(value));
  }
  return out;
}

}  // namespace bpms
