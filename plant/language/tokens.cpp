#include "plant/language/tokens.h"

#include <algorithm>

#include "plant/language/parse.h"

namespace bpms {
namespace {

bool is_latin_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}
bool is_single(char c) {
  return c == '{' || c == '}' || c == '(' || c == ')' || c == '=';
}

class Tokeniser {
 public:
  Tokeniser(const std::string& path, std::string_view text) : text_(text), out_{path, {}, {path}} {}

  PlantTokens run(bool with_comments) {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (is_blank(c)) {
        ++at_;
        if (c == '\n') ++line_, line_start_ = at_;
      } else if (c == '#') {
        const std::size_t end = std::min(text_.find('\n', at_), text_.size());
        if (with_comments) add(end);
        at_ = end;
      } else {
        const std::size_t end = token_end();
        add(end);
        at_ = end;
      }
    }
    out_.end = here();
    return std::move(out_);
  }

 private:
  int column() const { return static_cast<int>(at_ - line_start_) + 1; }
  SourceLocation here() const { return {out_.file, line_, column()}; }
  void add(std::size_t end) { out_.tokens.push_back({text_.substr(at_, end - at_), line_, column()}); }

  std::size_t token_end() const {
    std::size_t end = at_ + 1;
    if (is_single(text_[at_])) return end;
    if (text_[at_] == '"') {
      for (; end < text_.size() && text_[end] != '\n'; ++end) {
        if (text_[end] == '"') return end + 1;
        if (text_[end] == '\\' && end + 1 < text_.size() && text_[end + 1] != '\n') ++end;
      }
      syntax_error(here(), "string opened here is never closed, expected '\"' before the line ends");
    }
    while (end < text_.size() && !is_blank(text_[end]) && !is_single(text_[end]) && text_[end] != '#' &&
           text_[end] != '"')
      ++end;
    return end;
  }

  std::string_view text_;
  PlantTokens out_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1;
};

}  // namespace

SourceLocation PlantTokens::where(std::size_t token) const {
  return token < tokens.size() ? SourceLocation{file, tokens[token].line, tokens[token].column} : end;
}

PlantTokens plant_tokens(const std::string& path, std::string_view text, bool with_comments) {
  return Tokeniser(path, text).run(with_comments);
}

std::string unquoted(std::string_view token) {
  std::string out;
  for (std::size_t i = 1; i + 1 < token.size(); ++i) {
    if (token[i] == '\\' && (token[i + 1] == '"' || token[i + 1] == '\\') && i + 2 < token.size()) ++i;
    out += token[i];
  }
  return out;
}

std::string quoted(std::string_view value) {
  std::string out = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

bool is_plain_word(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return is_latin_letter(c) || is_digit(c) || c == '_' || c == '-' || c == '.';
  });
}

bool is_identifier(std::string_view text) {
  return !text.empty() && !is_digit(text.front()) &&
         std::ranges::all_of(text, [](char c) { return is_latin_letter(c) || is_digit(c) || c == '_'; });
}

}  // namespace bpms
