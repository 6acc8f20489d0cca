// Text files that know where they are: whole-file reading, tokens with line and column, numbers independent
// of locale.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace bpms {

// The whole file. Missing or unreadable: missing_resource. "FILE.gz" is unpacked.
std::string read_file(const std::string& path);
// The same for text: refuses empty files and binary content (NUL bytes) with bad_input that names the place.
// A UTF-8 byte order mark is dropped.
std::string read_text(const std::string& path);

// A finite decimal number, point as decimal sign; nullopt for anything else ("nan", "inf", "1,5", "12abc",
// 1e999).
std::optional<double> parse_number(std::string_view text);
std::optional<long long> parse_integer(std::string_view text);

struct Token {
  std::string_view text;
  int line = 0;
  int column = 0;
};

// Walks over a text in white-space separated tokens; '#' starts a comment that runs to the end of the line.
// The characters of `single` are tokens by themselves. The text must outlive the reader.
class TokenReader {
 public:
  TokenReader(std::string file, std::string_view text, std::string_view single = "");
  std::optional<Token> next();
  std::optional<Token> peek();
  SourceLocation where(const Token& token) const { return {file_, token.line, token.column}; }
  SourceLocation here() const { return {file_, line_, column_}; }  // just after the last token
  double number(std::string_view what);  // the next token as a number, or a located error
  const std::string& file() const { return file_; }

 private:
  void skip_space();
  std::string file_;
  std::string_view text_;
  std::string_view single_;
  std::size_t at_ = 0;
  int line_ = 1;
  int column_ = 1;
};

// Rows of numbers, white-space separated, '#' comments; every row has between `least` and `most` columns.
// Row i's line number is lines[i]. NaN, infinities, too large numbers (> 1e12) are located errors.
struct NumberTable {
  std::string file;
  std::vector<std::vector<double>> rows;
  std::vector<int> lines;
};
NumberTable read_number_table(const std::string& path, int least, int most,
                              std::string_view columns_in_words);

}  // namespace bpms
