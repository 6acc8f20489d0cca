#include "calibrate/lenses/lens.h"

#include <algorithm>
#include <array>

#include "calibrate/lenses/brown_conrady.h"
#include "calibrate/lenses/fisheye.h"
#include "calibrate/lenses/splined.h"
#include "core/error.h"
#include "core/nearest.h"
#include "core/text.h"

namespace bpms {
namespace {

const std::array all_lenses{&brown_conrady_lens, &fisheye_lens, &splined_lens};

}  // namespace

const Lens* find_lens(std::string_view model) {
  for (const auto& make : all_lenses)
    if (make().model() == model) return &make();
  return nullptr;
}

std::vector<std::string> lens_models() {
  std::vector<std::string> out;
  for (const auto& make : all_lenses) out.emplace_back(make().model());
  return out;
}

const std::vector<LensChoice>& lens_choices() {
  static const std::vector<LensChoice> choices{
      {"pinhole", "no distortion", "brown_conrady", 4},
      {"brown4", "k1 k2 p1 p2", "brown_conrady", 8},
      {"brown5", "k3 besides", "brown_conrady", 9, "brown4"},
      {"brown8", "rational, k4 k5 k6 besides", "brown_conrady", 12, "brown4"},
      {"fisheye", "k1 k2 k3 k4, to 90 degrees from the axis and beyond", "fisheye", 8},
      {"splined",
       "a surface of corrections on 12x9 knots; splined:16x12 for other grids",
       "splined_stereographic",
       splined_parameters(12, 9),
       "brown4",
       {3, 12, 9, 0}}};
  return choices;
}

LensChoice lens_choice(const std::string& name) {
  std::vector<std::string> names;
  for (const LensChoice& choice : lens_choices()) {
    if (choice.name == name) return choice;
    names.push_back(choice.name);
  }
  constexpr std::string_view prefix = "splined:";
  if (name.starts_with(prefix)) {
    const std::string_view grid = std::string_view(name).substr(prefix.size());
    const std::size_t cross = grid.find('x');
    const auto columns = parse_integer(grid.substr(0, cross));
    const auto rows = cross == grid.npos ? std::nullopt : parse_integer(grid.substr(cross + 1));
    constexpr long long fewest = 5, most = 60;
    if (!columns || !rows || std::min(*columns, *rows) < fewest || std::max(*columns, *rows) > most)
      bad_input({},
                "lens model {}; expected splined:COLUMNSxROWS with 5 to 60 knots each way, as splined:12x9",
                in_quotes(name));
    LensChoice out = lens_choice("splined");
    out.name = name;
    out.parameters = splined_parameters(static_cast<int>(*columns), static_cast<int>(*rows));
    out.constants = {3, static_cast<double>(*columns), static_cast<double>(*rows), 0};
    return out;
  }
  bad_input({}, "--model {}: no such lens; expected {}{}", in_quotes(name), fmt::join(names, ", "),
            did_you_mean(name, names));
}

}  // namespace bpms
