// The known word that a misspelt one was probably meant to be.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace bpms {
// Damerau-Levenshtein (optimal string alignment) distance, case-insensitive.
int edit_distance(std::string_view a, std::string_view b);
// Empty when nothing is near (more than about a third of the letters differ).
std::string nearest_word(std::string_view word, const std::vector<std::string>& known);
// "; did you mean 'x'?" or, with nothing near, "; known: a, b, c" (at most a dozen), or "".
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);
}  // namespace bpms
