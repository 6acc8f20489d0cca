#include "calibrate/yaml.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>

#include "core/text.h"

namespace bpms {
namespace {

constexpr double largest_yaml_number = 1e12;

// yaml-cpp recurses as deep as a document nests: what is deeper than any camera file is refused before.
void refuse_deep_yaml(const std::string& path, const std::string& text) {
  constexpr int deepest = 64;
  int flow = 0, line = 1;
  std::size_t start = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '[' || c == '{') ++flow;
    if (c == ']' || c == '}') --flow;
    if (c == '\n') {
      ++line;
      start = i + 1;
    }
    // "- - - -" and "? ? ?" nest too, and so does each deeper indent.
    if (flow > deepest)
      bad_input({path, line, static_cast<int>(i - start) + 1}, "nested deeper than {}", deepest);
  }
  int dashes = 0, indents = 0, last = -1;
  line = 1;
  bool leading = true;
  int column = 0;
  for (const char c : text) {
    if (c == '\n') {
      ++line;
      leading = true;
      dashes = column = 0;
      continue;
    }
    ++column;
    if (!leading) continue;
    if (c == '-' || c == '?' || c == ':') {
      if (++dashes > deepest) bad_input({path, line, column}, "nested deeper than {}", deepest);
    } else if (c != ' ' && c != '\t') {
      leading = false;
      if (column > last && ++indents > deepest)
        bad_input({path, line, column}, "nested deeper than {}", deepest);
      if (column == 1) indents = 0;
      last = column;
    }
  }
}

}  // namespace

YamlValue YamlValue::parse(const std::string& path, const std::string& text) {
  refuse_deep_yaml(path, text);
  YamlValue out;
  out.path_ = path;
  try {
    out.node_ = std::make_shared<const YAML::Node>(YAML::Load(text));
  } catch (const YAML::Exception& error) {
    bad_input({path, error.mark.line + 1, error.mark.column + 1}, "no YAML: {}", error.msg);
  }
  return out;
}

SourceLocation YamlValue::where() const {
  if (!node_) return {path_};
  const YAML::Mark mark = node_->Mark();
  return mark.is_null() ? SourceLocation{path_} : SourceLocation{path_, mark.line + 1, mark.column + 1};
}

bool YamlValue::is_table() const {
  return node_ && node_->IsMap();
}
bool YamlValue::is_list() const {
  return node_ && node_->IsSequence();
}

std::vector<std::string> YamlValue::keys() const {
  std::vector<std::string> out;
  if (!is_table()) return out;
  for (const auto& entry : *node_) {
    if (!entry.first.IsScalar()) reject("expected keys that are words");
    out.push_back(entry.first.Scalar());
  }
  return out;
}

YamlValue YamlValue::get(const std::string& key) const {
  YamlValue out;
  out.path_ = path_;
  out.name_ = name_.empty() ? key : name_ + "." + key;
  if (!is_table()) return out;
  for (const auto& entry : *node_) {
    if (!entry.first.IsScalar() || entry.first.Scalar() != key) continue;
    if (out) {
      const YAML::Mark mark = entry.first.Mark();
      bad_input({path_, mark.line + 1, mark.column + 1}, "{} is there twice", in_quotes(key));
    }
    out.node_ = std::make_shared<const YAML::Node>(entry.second);
  }
  return out;
}

YamlValue YamlValue::require(const std::string& key) const {
  if (!is_table()) reject("expected a table");
  YamlValue out = get(key);
  if (!out) bad_input(where(), "missing key {}", in_quotes(out.name_));
  return out;
}

std::size_t YamlValue::size() const {
  return node_ ? node_->size() : 0;
}

YamlValue YamlValue::operator[](std::size_t index) const {
  YamlValue out;
  out.path_ = path_;
  out.name_ = fmt::format("{}[{}]", name_, index);
  if (is_list() && index < node_->size()) out.node_ = std::make_shared<const YAML::Node>((*node_)[index]);
  return out;
}

std::string YamlValue::string() const {
  if (!node_ || !node_->IsScalar()) reject("expected a text");
  return node_->Scalar();
}

double YamlValue::number() const {
  const std::string text = string();
  const bool point = text.ends_with('.');  // "1." is a number of YAML's
  const auto out = parse_number(point ? text + "0" : text);
  if (!out || std::abs(*out) > largest_yaml_number)
    reject(fmt::format("found {}, expected a number of at most 1e12", in_quotes(text)));
  return *out;
}

long long YamlValue::integer(long long low, long long high) const {
  const std::string text = string();
  const auto out = parse_integer(text);
  if (!out || *out < low || *out > high)
    reject(fmt::format("found {}, expected an integer from {} to {}", in_quotes(text), low, high));
  return *out;
}

std::vector<double> YamlValue::numbers() const {
  if (!is_list()) reject("expected a list of numbers");
  std::vector<double> out;
  for (std::size_t i = 0; i < size(); ++i) out.push_back((*this)[i].number());
  return out;
}

std::vector<double> YamlValue::numbers(std::size_t count) const {
  std::vector<double> out = numbers();
  if (out.size() != count) reject(fmt::format("{} numbers, expected {}", out.size(), count));
  return out;
}

void YamlValue::reject(const std::string& message) const {
  bad_input(where(), "{}{}{}", name_, name_.empty() ? "" : ": ", message);
}

std::string yaml_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20)
      out += fmt::format("\\x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    else
      out += c;
  }
  return out + "\"";
}

}  // namespace bpms
