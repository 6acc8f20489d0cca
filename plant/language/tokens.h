// The tokens of a plant text: runs of characters between white space; each of { } ( ) = and a "quoted string"
// is one by itself. '#' starts a comment that runs to the end of the line.
#pragma once
#include <string>
#include <vector>

#include "core/text.h"

namespace bpms {

struct PlantTokens {
  std::string file;
  std::vector<Token> tokens;  // of a text that must outlive them
  SourceLocation end;
  SourceLocation where(std::size_t token) const;
  bool is(std::size_t token, std::string_view text) const {
    return token < tokens.size() && tokens[token].text == text;
  }
};

PlantTokens plant_tokens(const std::string& path, std::string_view text, bool with_comments = false);

// The value of a "quoted string" with \" and \\ in it, and the other way round.
std::string unquoted(std::string_view token);
std::string quoted(std::string_view value);
// Letters, digits, _ - . : what needs no quotes.
bool is_plain_word(std::string_view text);
// A letter or _, then letters, digits and _: the name of a constant, a parameter or an organ.
bool is_identifier(std::string_view text);

}  // namespace bpms
