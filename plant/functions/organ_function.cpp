#include "plant/organ_function.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/nearest.h"
#include "plant/functions/kinds.h"

namespace bpms {

OrganFunctionKind piecewise_linear_kind(), power_series_kind(), cosine_series_kind(), cubic_spline_kind();

namespace {

constexpr std::size_t most_numbers = 400;
constexpr double largest_number = 1e6;

const std::vector<OrganFunctionKind>& kinds() {
  static const std::vector<OrganFunctionKind> table{
      piecewise_linear_kind(),
      power_series_kind(),
      cosine_series_kind(),
      cubic_spline_kind(),
  };
  return table;
}

const OrganFunctionKind& kind_of(char code, const SourceLocation& where) {
  std::string known;
  for (const OrganFunctionKind& kind : kinds()) {
    if (kind.code == code) return kind;
    known += fmt::format("{}{} ({})", known.empty() ? "" : ", ", kind.code, kind.name);
  }
  std::string hint;
  const auto lower = static_cast<char>(std::tolower(static_cast<unsigned char>(code)));
  if (std::ranges::any_of(kinds(), [&](const OrganFunctionKind& kind) { return kind.code == lower; }))
    hint = fmt::format("; did you mean '{}'?", lower);
  bad_input(where, "unknown function code {}{} known: {}", in_quotes(std::string(1, code)),
            hint.empty() ? ";" : hint, known);
}

}  // namespace

void require_knots(char code, const std::vector<double>& numbers, const SourceLocation& where) {
  if (numbers.size() < 4 || numbers.size() % 2 != 0)
    bad_input(where, "function {} has {} numbers, expected pairs l value l value ..., at least two", code,
              numbers.size());
  if (numbers[0] != 0) bad_input(where, "function {} begins at l = {}, expected 0", code, numbers[0]);
  for (std::size_t i = 2; i < numbers.size(); i += 2) {
    if (!(numbers[i] > numbers[i - 2]))
      bad_input(where, "function {}: l = {} of pair {} does not rise above {} of the pair before it", code,
                numbers[i], i / 2 + 1, numbers[i - 2]);
  }
  if (const double last = numbers[numbers.size() - 2]; last != 1)
    bad_input(where, "function {} ends at l = {}, expected 1", code, last);
}

std::vector<double> even_knots(int count) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) {
    out.push_back(static_cast<double>(i) / (count - 1));
    out.push_back(0);
  }
  return out;
}

std::vector<double> zero_coefficients(int order) {
  return std::vector<double>(static_cast<std::size_t>(order) + 1, 0.0);
}

std::size_t knot_interval(std::span<const double> knots, double l) {
  const auto after = std::upper_bound(knots.begin() + 1, knots.end() - 1, l);
  return static_cast<std::size_t>(after - knots.begin()) - 1;
}

std::unique_ptr<OrganFunction> make_organ_function(char code, std::vector<double> numbers, double scale,
                                                   const SourceLocation& where) {
  const OrganFunctionKind& kind = kind_of(code, where);
  if (numbers.empty()) bad_input(where, "function {} has no numbers, expected {}", code, kind.layout);
  if (numbers.size() > most_numbers)
    bad_input(where, "function {} has {} numbers, more than {}", code, numbers.size(), most_numbers);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!std::isfinite(numbers[i]) || std::abs(numbers[i]) > largest_number)
      bad_input(where, "function {}: number {} is {}, expected a finite number up to {}", code, i + 1,
                numbers[i], largest_number);
  }
  return kind.make(std::move(numbers), scale, where);
}

std::unique_ptr<OrganFunction> blank_organ_function(char code, int order, double scale) {
  const OrganFunctionKind& kind = kind_of(code, {});
  const bool knots = kind.blank(2).size() == 4;
  const int least = knots ? 2 : 0;
  if (order < least || order > static_cast<int>(most_numbers) / 2 - 1)
    bad_input({}, "function {}:{}: expected an order from {} to {}", code, order, least,
              most_numbers / 2 - 1);
  return kind.make(kind.blank(order), scale, {});
}

std::string organ_function_text(const OrganFunction& function) {
  std::string out(1, function.code());
  for (const double number : function.numbers()) fmt::format_to(std::back_inserter(out), " {}", number);
  return out;
}

}  // namespace bpms
