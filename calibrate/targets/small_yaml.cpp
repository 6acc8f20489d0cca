#include "calibrate/targets/small_yaml.h"

#include <cctype>

#include "core/text.h"

namespace bpms {
namespace {

class YamlReader {
 public:
  YamlReader(const std::string& path, std::string_view text) : path_(path), text_(text) {}

  SmallYaml document() {
    SmallYaml out = start(SmallYaml::Kind::map);
    skip_blank();
    if (text_.substr(at_).starts_with("---")) advance(3), skip_blank();
    while (at_ < text_.size()) {
      if (column_ != 1) bad_input(here(), "expected KEY: VALUE at the beginning of a line");
      entry(out, "\n:", 0);
      while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\r')) advance(1);
      if (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '#')
        bad_input(here(), "expected the end of the line");
      skip_blank();
    }
    return out;
  }

 private:
  static constexpr int deepest = 20;

  SourceLocation here() const { return {path_, line_, column_}; }
  void advance(std::size_t count) {
    for (; count > 0 && at_ < text_.size(); --count, ++at_) {
      if (text_[at_] == '\n')
        ++line_, column_ = 1;
      else
        ++column_;
    }
  }
  // White space, line ends and comments.
  void skip_blank() {
    while (at_ < text_.size()) {
      if (text_[at_] == '#') {
        while (at_ < text_.size() && text_[at_] != '\n') advance(1);
      } else if (std::isspace(static_cast<unsigned char>(text_[at_]))) {
        advance(1);
      } else {
        return;
      }
    }
  }
  SmallYaml start(SmallYaml::Kind kind) const {
    SmallYaml out;
    out.kind = kind;
    out.where = here();
    return out;
  }
  void expect(char c) {
    if (at_ >= text_.size() || text_[at_] != c)
      bad_input(here(), "expected {}", in_quotes(std::string(1, c)));
    advance(1);
  }

  // Up to one of `ends`, or quoted.
  SmallYaml word(std::string_view ends) {
    SmallYaml out = start(SmallYaml::Kind::word);
    const char first = at_ < text_.size() ? text_[at_] : '\0';
    if (first == '\'' || first == '"') {
      advance(1);
      while (at_ < text_.size() && text_[at_] != first && text_[at_] != '\n')
        out.word += text_[at_], advance(1);
      expect(first);
      return out;
    }
    while (at_ < text_.size() && ends.find(text_[at_]) == std::string_view::npos && text_[at_] != '\n' &&
           text_[at_] != '#')
      out.word += text_[at_], advance(1);
    while (!out.word.empty() && std::isspace(static_cast<unsigned char>(out.word.back())))
      out.word.pop_back();
    return out;
  }

  void entry(SmallYaml& map, std::string_view ends, int depth) {
    const SmallYaml key = word(":,}]\n");
    if (key.word.empty()) bad_input(here(), "expected KEY: VALUE");
    skip_blank();
    expect(':');
    skip_blank();
    if (map.find(key.word)) bad_input(key.where, "{} is there twice", in_quotes(key.word));
    map.keys.push_back(key.word);
    map.items.push_back(value(ends, depth));
  }

  SmallYaml value(std::string_view ends, int depth) {
    if (depth > deepest) bad_input(here(), "nested deeper than {} times", deepest);
    if (at_ < text_.size() && text_[at_] == '{') return flow_map(depth);
    if (at_ < text_.size() && text_[at_] == '[') return flow_list(depth);
    return word(ends);
  }

  SmallYaml flow_map(int depth) {
    SmallYaml out = start(SmallYaml::Kind::map);
    expect('{');
    for (skip_blank(); at_ < text_.size() && text_[at_] != '}'; skip_blank()) {
      entry(out, ",}", depth + 1);
      skip_blank();
      if (at_ < text_.size() && text_[at_] != '}') expect(',');
    }
    expect('}');
    return out;
  }

  SmallYaml flow_list(int depth) {
    SmallYaml out = start(SmallYaml::Kind::list);
    expect('[');
    for (skip_blank(); at_ < text_.size() && text_[at_] != ']'; skip_blank()) {
      out.items.push_back(value(",]", depth + 1));
      skip_blank();
      if (at_ < text_.size() && text_[at_] != ']') expect(',');
    }
    expect(']');
    return out;
  }

  std::string path_;
  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1, column_ = 1;
};

}  // namespace

SmallYaml SmallYaml::parse(const std::string& path, std::string_view text) {
  return YamlReader(path, text).document();
}

const SmallYaml* SmallYaml::find(std::string_view key) const {
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i] == key) return &items[i];
  }
  return nullptr;
}

const SmallYaml& SmallYaml::require(std::string_view key) const {
  if (kind != Kind::map) reject("expected KEY: VALUE pairs");
  const SmallYaml* found = find(key);
  if (!found) reject(fmt::format("missing key {}", in_quotes(key)));
  return *found;
}

double SmallYaml::number() const {
  const auto out = parse_number(word);
  if (kind != Kind::word || !out) reject(fmt::format("{}; expected a number", in_quotes(word)));
  return *out;
}

long long SmallYaml::integer(long long low, long long high) const {
  const auto out = parse_integer(word);
  if (kind != Kind::word || !out || *out < low || *out > high)
    reject(fmt::format("{}; expected an integer from {} to {}", in_quotes(word), low, high));
  return *out;
}

void SmallYaml::reject(const std::string& message) const {
  bad_input(where, "{}", message);
}

}  // namespace bpms
