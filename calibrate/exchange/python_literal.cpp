#include "calibrate/exchange/python_literal.h"

#include <cmath>

#include "calibrate/exchange/camera_numbers.h"
#include "core/text.h"

namespace bpms {
namespace {

class PythonReader {
 public:
  PythonReader(const std::string& path, std::string_view text) : path_(path), text_(text) {}

  PythonLiteral whole() {
    PythonLiteral out = value(0);
    skip();
    if (at_ < text_.size()) bad_input(where(), "something follows the end of the dictionary");
    return out;
  }

 private:
  static constexpr int deepest = 32;

  SourceLocation where() const { return {path_, line_, static_cast<int>(at_ - line_start_) + 1}; }
  char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void step() {
    if (text_[at_] == '\n') {
      ++line_;
      line_start_ = at_ + 1;
    }
    ++at_;
  }
  void skip() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '#') {
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      } else if (c == ' ' || c == '\t' || c == '\r' || c == '\n') {
        step();
      } else {
        return;
      }
    }
  }
  void expect(char c, const char* what) {
    skip();
    if (here() != c || at_ >= text_.size()) {
      if (at_ >= text_.size()) bad_input(where(), "the file ends, expected {}", what);
      bad_input(where(), "found {}, expected {}", in_quotes(text_.substr(at_, 1)), what);
    }
    step();
  }

  PythonLiteral value(int depth) {
    skip();
    if (depth > deepest) bad_input(where(), "nested deeper than {}", deepest);
    PythonLiteral out;
    out.where = where();
    const char c = here();
    if (c == '{') {
      dictionary(out, depth);
    } else if (c == '[' || c == '(') {
      list(out, depth, c == '[' ? ']' : ')');
    } else if (c == '\'' || c == '"') {
      out.kind = PythonLiteral::Kind::text;
      out.text = quoted(true);
    } else if (c == 'b' && at_ + 1 < text_.size() && (text_[at_ + 1] == '\'' || text_[at_ + 1] == '"')) {
      step();
      out.kind = PythonLiteral::Kind::bytes;
      quoted(false);
    } else {
      word(out);
    }
    return out;
  }

  void dictionary(PythonLiteral& out, int depth) {
    out.kind = PythonLiteral::Kind::dictionary;
    step();
    for (skip(); here() != '}'; skip()) {
      const SourceLocation key_at = where();
      if (here() != '\'' && here() != '"')
        bad_input(key_at, "{}",
                  at_ >= text_.size() ? "the file ends inside a dictionary"
                                      : "expected a key in quotes, or the end '}'");
      const std::string key = quoted(true);
      if (out.find(key) != nullptr) bad_input(key_at, "the key {} is there twice", in_quotes(key));
      expect(':', "':' after a key");
      PythonLiteral item = value(depth + 1);
      out.keys.push_back(key);
      out.items.push_back(std::move(item));
      skip();
      if (here() == ',')
        step();
      else if (here() != '}')
        expect('}', "',' or '}'");
    }
    step();
  }

  void list(PythonLiteral& out, int depth, char end) {
    out.kind = PythonLiteral::Kind::list;
    step();
    for (skip(); here() != end; skip()) {
      out.items.push_back(value(depth + 1));
      skip();
      if (here() == ',')
        step();
      else if (here() != end)
        expect(end, "',' or the end of the list");
    }
    step();
  }

  // Without escapes of characters but quotes and backslashes: keys and names of models have none.
  std::string quoted(bool keep) {
    const SourceLocation start = where();
    const char quote = here();
    std::string out;
    for (step(); here() != quote || at_ >= text_.size(); step()) {
      if (at_ >= text_.size() || here() == '\n') bad_input(start, "this text does not end on its line");
      if (here() == '\\') {
        step();
        if (at_ >= text_.size()) bad_input(start, "this text does not end on its line");
      }
      if (keep) out += here();
    }
    step();
    return out;
  }

  void word(PythonLiteral& out) {
    const std::size_t begin = at_;
    while (at_ < text_.size() && std::string_view(",:]})#\n\r\t ").find(text_[at_]) == std::string_view::npos)
      ++at_;
    const std::string_view found = text_.substr(begin, at_ - begin);
    if (found == "None") return;
    if (found == "True" || found == "False") {
      out.kind = PythonLiteral::Kind::truth;
      out.number = found == "True";
      return;
    }
    std::string plain(found);  // "1." is a number of Python's
    const auto number = parse_number(plain.ends_with('.') ? plain + "0" : plain);
    if (!number) {
      if (found.empty() && at_ >= text_.size()) bad_input(out.where, "the file ends, expected a value");
      bad_input(out.where, "found {}, expected a number, a text, a list or a dictionary", in_quotes(found));
    }
    out.kind = PythonLiteral::Kind::number;
    out.number = *number;
  }

  const std::string& path_;
  std::string_view text_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1;
};

}  // namespace

const PythonLiteral* PythonLiteral::find(std::string_view key) const {
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (keys[i] == key) return &items[i];
  return nullptr;
}

std::vector<double> PythonLiteral::numbers(const char* what) const {
  if (kind != Kind::list) bad_input(where, "{}: expected a list of numbers", what);
  std::vector<double> out;
  for (const PythonLiteral& item : items) {
    if (item.kind != Kind::number || std::abs(item.number) > largest_camera_number)
      bad_input(item.where, "{}: expected a number of at most 1e12", what);
    out.push_back(item.number);
  }
  return out;
}

PythonLiteral parse_python_literal(const std::string& path, std::string_view text) {
  return PythonReader(path, text).whole();
}

}  // namespace bpms
