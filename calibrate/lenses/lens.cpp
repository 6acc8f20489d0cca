#include "calibrate/lenses/lens.h"

#include <array>

#include "calibrate/lenses/brown_conrady.h"
#include "core/error.h"
#include "core/nearest.h"
#include "core/text.h"

namespace bpms {
namespace {

const std::array all_lenses{&brown_conrady_lens};

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
      {"brown8", "rational, k4 k5 k6 besides", "brown_conrady", 12, "brown4"}};
  return choices;
}

const LensChoice& lens_choice(const std::string& name) {
  std::vector<std::string> names;
  for (const LensChoice& choice : lens_choices()) {
    if (choice.name == name) return choice;
    names.push_back(choice.name);
  }
  bad_input({}, "no lens model {}; expected {}{}", in_quotes(name), fmt::join(names, ", "),
            did_you_mean(name, names));
}

}  // namespace bpms
