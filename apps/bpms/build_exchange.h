// `bpms build` for what is not a plant text into a mesh: plants of other programs, graphs, stands.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/bpms/verb.h"

namespace bpms {

struct ExchangeArguments {
  std::string unit = "cm", diameter_unit;  // of MTG and OPF; diameters: the same unless given
  std::optional<int> steps;                // of an L-system
};
void add_exchange_options(CLI::App* verb, ExchangeArguments& options);

struct ExchangeBuild {
  std::string input;
  std::vector<std::string> outputs;
  double tolerance_m = 1e-4;
  bool lenient = false;
};
// False: a plant text and meshes alone, which the verb builds itself.
bool build_exchange(const Cli& cli, const ExchangeBuild& build, const ExchangeArguments& options);

}  // namespace bpms
