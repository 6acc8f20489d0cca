#include "core/text.h"

#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>

#include "core/skip_blanks.h"

namespace bpms {

std::string read_file(const std::string& path) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (!std::filesystem::exists(status)) fail(ErrorKind::missing_resource, {path}, "no such file");
  if (std::filesystem::is_directory(status))
    fail(ErrorKind::missing_resource, {path}, "is a folder, a file was expected");
  if (std::filesystem::is_character_file(status) || std::filesystem::is_block_file(status))
    fail(ErrorKind::missing_resource, {path}, "is a device, a file was expected");  // it may never end
  // zlib reads plain files as they are, so one path serves both.
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), &gzclose);
  if (!file) fail(ErrorKind::missing_resource, {path}, "cannot be opened: {}", std::strerror(errno));
  std::string out;
  std::vector<char> buffer(1 << 20);
  for (;;) {
    const int got = gzread(file.get(), buffer.data(), static_cast<unsigned>(buffer.size()));
    if (got < 0) bad_input({path}, "cannot be read (damaged compression?)");
    if (got == 0) break;
    out.append(buffer.data(), static_cast<std::size_t>(got));
  }
  int code_z = 0;
  gzerror(file.get(), &code_z);
  if (code_z == Z_BUF_ERROR) bad_input({path}, "ends in the middle of its compressed data");
  return out;
}

std::string read_text(const std::string& path) {
  std::string text = read_file(path);
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  if (const std::size_t nul = text.find('\0'); nul != std::string::npos) {
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(nul), '\n');
    bad_input({path, static_cast<int>(line)}, "binary content (a NUL byte), text was expected");
  }
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) bad_input({path}, "the file is empty");
  return text;
}

std::optional<double> parse_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  if (text.empty()) return std::nullopt;
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<long long> parse_integer(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  long long value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || code != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

void skip_blanks(std::string_view text, std::size_t& at, int& line, int& column) {
  while (at < text.size()) {
    const char c = text[at];
    if (c == '#') {
      while (at < text.size() && text[at] != '\n') ++at, ++column;
    } else if (c == '\n') {
      ++at, ++line;
      column = 1;
    } else if (c == ' ' || c == '\t' || c == '\r') {
      ++at, ++column;
    } else {
      return;
    }
  }
}

TokenReader::TokenReader(std::string file, std::string_view text, std::string_view single)
    : file_(std::move(file)), text_(text), single_(single) {}

void TokenReader::skip_space() {
  skip_blanks(text_, at_, line_, column_);
}

std::optional<Token> TokenReader::next() {
  skip_space();
  if (at_ >= text_.size()) return std::nullopt;
  Token token{{}, line_, column_};
  const std::size_t begin = at_;
  if (single_.find(text_[at_]) != std::string_view::npos) {
    ++at_;
  } else {
    while (at_ < text_.size() && std::strchr(" \t\r\n#", text_[at_]) == nullptr &&
           single_.find(text_[at_]) == std::string_view::npos) {
      ++at_;
    }
    if (at_ == begin) ++at_;  // a NUL byte matches strchr's end; take it as a token of its own
  }
  token.text = text_.substr(begin, at_ - begin);
  column_ += static_cast<int>(at_ - begin);
  return token;
}

std::optional<Token> TokenReader::peek() {
  const auto state = std::tuple(at_, line_, column_);
  const auto token = next();
  std::tie(at_, line_, column_) = state;
  return token;
}

double TokenReader::number(std::string_view what) {
  const auto token = next();
  if (!token) bad_input(here(), "the file ends where {} was expected", what);
  const auto value = parse_number(token->text);
  if (!value)
    bad_input(where(*token), "found {}, expected {} (a finite number)", in_quotes(token->text), what);
  return *value;
}

NumberTable read_number_table(const std::string& path, int least, int most,
                              std::string_view columns_in_words) {
  constexpr double largest = 1e12;
  const std::string text = read_text(path);
  NumberTable table{path, {}, {}};
  TokenReader reader(path, text);
  int line = 0;
  const auto check_row = [&] {
    if (table.rows.empty()) return;
    const auto count = static_cast<int>(table.rows.back().size());
    if (count < least || count > most)
      bad_input({path, table.lines.back()}, "{} columns, expected {} ({})", count,
                least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most),
                columns_in_words);
  };
  while (const auto token = reader.next()) {
    if (token->line != line) {
      check_row();
      line = token->line;
      table.rows.emplace_back();
      table.lines.push_back(line);
    }
    const auto value = parse_number(token->text);
    if (!value || std::abs(*value) > largest)
      bad_input(reader.where(*token), "found {}, expected a finite number ({})", in_quotes(token->text),
                columns_in_words);
    table.rows.back().push_back(*value);
  }
  check_row();
  if (table.rows.empty()) bad_input({path}, "no rows, expected {}", columns_in_words);
  return table;
}

}  // namespace bpms
