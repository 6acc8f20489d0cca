#include "fit/function_choice.h"

#include <cmath>
#include <limits>

#include "core/nearest.h"
#include "core/text.h"

namespace bpms {
namespace {

constexpr int highest_order = 12;

std::optional<FunctionChoice> parse_choice(std::string_view text) {
  if (text == "auto") return std::nullopt;
  const std::size_t colon = text.find(':');
  const auto order = colon == std::string_view::npos ? std::nullopt : parse_integer(text.substr(colon + 1));
  const bool knots = text.starts_with('n') || text.starts_with('s');
  if (colon != 1 || std::string_view("npfs").find(text[0]) == std::string_view::npos || !order)
    bad_input({}, "found {} as function, expected auto, n:KNOTS, p:DEGREE, f:HARMONICS or s:KNOTS, as p:3",
              in_quotes(text));
  const int least = knots ? 2 : 0;
  if (*order < least || *order > highest_order)
    bad_input({}, "function {}: found order {}, expected {} to {}", in_quotes(text), *order, least,
              highest_order);
  return FunctionChoice{text[0], static_cast<int>(*order)};
}

}  // namespace

FunctionRequest parse_function_request(std::string_view text) {
  FunctionRequest out;
  if (text.find('=') == std::string_view::npos) {
    const auto choice = parse_choice(text);
    return {choice, choice, choice, choice};
  }
  while (!text.empty()) {
    const std::string_view part = text.substr(0, text.find(','));
    text.remove_prefix(std::min(text.size(), part.size() + 1));
    const std::size_t equal = part.find('=');
    const std::string_view name = part.substr(0, equal);
    std::optional<FunctionChoice>* role = name == "inclination" ? &out.inclination
                                          : name == "azimuth"   ? &out.azimuth
                                          : name == "twist"     ? &out.twist
                                          : name == "width"     ? &out.width
                                                                : nullptr;
    if (equal == std::string_view::npos || role == nullptr)
      bad_input({}, "found {} in --function, expected NAME=KIND:ORDER{}", in_quotes(part),
                did_you_mean(name, {"inclination", "azimuth", "twist", "width"}));
    *role = parse_choice(part.substr(equal + 1));
  }
  return out;
}

std::string role_name(FunctionRole role) {
  switch (role) {
    case FunctionRole::inclination:
      return "inclination";
    case FunctionRole::azimuth:
      return "azimuth";
    case FunctionRole::twist:
      return "twist";
    case FunctionRole::width:
      return "width";
  }
  return "";
}

std::vector<FunctionChoice> function_candidates(FunctionRole role) {
  switch (role) {
    case FunctionRole::inclination:
      return {{'p', 0}, {'p', 1}, {'p', 2}, {'p', 3}, {'p', 4}, {'p', 5}, {'f', 1},
              {'f', 2}, {'f', 3}, {'f', 4}, {'f', 5}, {'n', 3}, {'n', 4}, {'n', 5},
              {'n', 6}, {'s', 3}, {'s', 4}, {'s', 5}, {'s', 6}};
    case FunctionRole::azimuth:
    case FunctionRole::twist:
      return {{'p', 0}, {'p', 1}, {'p', 2}, {'p', 3}, {'p', 4}, {'f', 1}, {'f', 2},
              {'f', 3}, {'n', 3}, {'n', 4}, {'n', 5}, {'s', 3}, {'s', 4}, {'s', 5}};
    case FunctionRole::width:
      return {{'p', 1}, {'p', 2}, {'p', 3}, {'p', 4}, {'p', 5}, {'f', 2}, {'f', 3}, {'f', 4},
              {'n', 3}, {'n', 4}, {'n', 5}, {'n', 6}, {'s', 4}, {'s', 5}, {'s', 6}};
  }
  return {};
}

double corrected_akaike(double chi2, int residuals, int parameters, bool errors_known, double inflation) {
  const double n = residuals, k = parameters + (errors_known ? 0 : 1);
  if (n <= k + 1) return std::numeric_limits<double>::infinity();
  constexpr double exact = 1e-300;  // a leaf without noise fits exactly
  const double misfit = errors_known ? chi2 / inflation : n * std::log(std::max(exact, chi2) / n);
  return misfit + 2 * k + 2 * k * (k + 1) / (n - k - 1);
}

}  // namespace bpms
