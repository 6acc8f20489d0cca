// The steps of reading a plant text: tokens -> unit, word, blocks -> which block shapes which organ.
#pragma once
#include <vector>

#include "core/text.h"
#include "plant/plant.h"

namespace bpms {

// The text does not follow the grammar.
template <class... Args>
[[noreturn]] void syntax_error(const SourceLocation& where, fmt::format_string<Args...> format,
                               Args&&... args) {
  throw Error(ErrorKind::bad_input, where,
              "syntax error: " + fmt::format(format, std::forward<Args>(args)...));
}
// The grammar holds, but what is said cannot be.
template <class... Args>
[[noreturn]] void semantic_error(const SourceLocation& where, fmt::format_string<Args...> format,
                                 Args&&... args) {
  throw Error(ErrorKind::bad_input, where,
              "semantic error: " + fmt::format(format, std::forward<Args>(args)...));
}

struct PlantTokens {
  std::string file;
  std::vector<Token> tokens;
  SourceLocation end;
  SourceLocation where(std::size_t token) const;
};

// The word in tokens [begin, end): letters with labels, brackets balanced (with `lenient`: closed at the end,
// noted).
void parse_word(const PlantTokens& text, std::size_t begin, std::size_t end, bool lenient, Plant& plant);
// A block that begins at token `at`, which is moved behind it.
Block parse_block(const PlantTokens& text, std::size_t& at, double metres);
// Gives every organ its block; notes what is ambiguous, unused or missing.
void assign_blocks(Plant& plant);

}  // namespace bpms
