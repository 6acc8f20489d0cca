#include "core/toml.h"

#include <toml++/toml.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "core/nearest.h"
#include "core/text.h"

namespace bpms {

struct TomlDocument::State {
  std::string path;
  toml::table table;
  std::map<const void*, std::set<std::string, std::less<>>> known;  // keys that were asked of each table
};

namespace {

const toml::node* as_node(const void* node) {
  return static_cast<const toml::node*>(node);
}

SourceLocation location(const std::string& path, const toml::source_region& region) {
  return {path, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

std::string type_in_words(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "the text " + in_quotes(node.as_string()->get());
    case toml::node_type::integer:
      return fmt::format("the number {}", node.as_integer()->get());
    case toml::node_type::floating_point:
      return fmt::format("the number {}", node.as_floating_point()->get());
    case toml::node_type::boolean:
      return node.as_boolean()->get() ? "true" : "false";
    default:
      return "a date or time";
  }
}

// The parser recurses over brackets; hostile nesting must not reach its own limit by way of the stack.
void refuse_deep_nesting(const std::string& path, std::string_view text) {
  constexpr int deepest = 100;
  int depth = 0;
  int line = 1;
  for (const char c : text) {
    if (c == '\n') ++line;
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') depth = std::max(0, depth - 1);
    if (depth > deepest) bad_input({path, line}, "brackets nested deeper than {}", deepest);
  }
}

using Known = std::map<const void*, std::set<std::string, std::less<>>>;

void refuse_unknown(const std::string& path, const toml::table& table, const toml::key& key,
                    const Known& known) {
  const auto asked = known.find(&table);
  if (asked != known.end() && asked->second.contains(key.str())) return;
  std::vector<std::string> words;
  if (asked != known.end()) words.assign(asked->second.begin(), asked->second.end());
  bad_input(location(path, key.source()), "unknown key {}{}", in_quotes(key.str()),
            did_you_mean(key.str(), words));
}

void report_unknown(const std::string& path, const toml::node& node, const Known& known) {
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& element : *array) report_unknown(path, element, known);
    return;
  }
  const toml::table* table = node.as_table();
  if (table == nullptr) return;
  for (const auto& [key, value] : *table) {
    refuse_unknown(path, *table, key, known);
    report_unknown(path, value, known);
  }
}

}  // namespace

TomlDocument TomlDocument::read(const std::string& path) {
  return parse(path, read_text(path));
}

TomlDocument TomlDocument::parse(const std::string& path, std::string_view text) {
  refuse_deep_nesting(path, text);
  TomlDocument document;
  document.state_ = std::make_shared<State>();
  document.state_->path = path;
  try {
    document.state_->table = toml::parse(text, path);
  } catch (const toml::parse_error& error) {
    throw Error(ErrorKind::bad_input, location(path, error.source()), std::string(error.description()));
  }
  return document;
}

TomlValue TomlDocument::root() const {
  return {state_, static_cast<const toml::node*>(&state_->table), nullptr, ""};
}
const std::string& TomlDocument::path() const {
  return state_->path;
}
void TomlDocument::finish() const {
  report_unknown(state_->path, state_->table, state_->known);
}

TomlValue::TomlValue(std::shared_ptr<TomlDocument::State> state, const void* node, const void* parent,
                     std::string name)
    : state_(std::move(state)), node_(node), parent_(parent), name_(std::move(name)) {}

SourceLocation TomlValue::where() const {
  const void* node = node_ != nullptr ? node_ : parent_;
  return node == nullptr ? SourceLocation{state_->path} : location(state_->path, as_node(node)->source());
}

std::string TomlValue::file_relative(std::string_view path) const {
  const std::filesystem::path wanted(path);
  if (wanted.is_absolute()) return std::string(path);
  return (std::filesystem::path(state_->path).parent_path() / wanted).string();
}

void TomlValue::reject(const std::string& message) const {
  const std::string who = name_.empty() ? "" : name_ + ": ";
  throw Error(ErrorKind::bad_input, where(), who + message);
}

void TomlValue::reject_choice(const std::string& message) const {
  const toml::table* table = node_ != nullptr ? as_node(node_)->as_table() : nullptr;
  if (table != nullptr) {
    for (const auto& [key, value] : *table) refuse_unknown(state_->path, *table, key, state_->known);
  }
  reject(message);
}

TomlValue TomlValue::get(std::string_view key) const {
  if (node_ == nullptr) return *this;
  const toml::table* table = as_node(node_)->as_table();
  if (table == nullptr) reject("found " + type_in_words(*as_node(node_)) + ", expected a table");
  state_->known[node_].emplace(key);
  return {state_, table->get(key), node_, name_.empty() ? std::string(key) : name_ + "." + std::string(key)};
}

TomlValue TomlValue::require(std::string_view key) const {
  TomlValue value = get(key);
  if (value) return value;
  const toml::table* table = node_ != nullptr ? as_node(node_)->as_table() : nullptr;
  std::string hint;
  if (table != nullptr) {  // a misspelt key is the likeliest reason for a missing one
    for (const auto& [other, node] : *table) {
      if (!state_->known[node_].contains(other.str()) &&
          !nearest_word(other.str(), {std::string(key)}).empty())
        bad_input(location(state_->path, other.source()), "unknown key {}; did you mean '{}'?",
                  in_quotes(other.str()), key);
    }
  }
  throw Error(ErrorKind::bad_input, where(),
              fmt::format("missing key '{}'{}", key, name_.empty() ? std::string() : " in [" + name_ + "]"));
}

bool TomlValue::has(std::string_view key) const {
  return static_cast<bool>(get(key));
}

std::vector<std::string> TomlValue::keys() const {
  std::vector<std::string> out;
  if (node_ == nullptr) return out;
  const toml::table* table = as_node(node_)->as_table();
  if (table == nullptr) reject("found " + type_in_words(*as_node(node_)) + ", expected a table");
  for (const auto& [key, value] : *table) out.emplace_back(key.str());
  return out;
}

bool TomlValue::is_table() const {
  return node_ != nullptr && as_node(node_)->is_table();
}
bool TomlValue::is_array() const {
  return node_ != nullptr && as_node(node_)->is_array();
}
bool TomlValue::is_string() const {
  return node_ != nullptr && as_node(node_)->is_string();
}
bool TomlValue::is_number() const {
  return node_ != nullptr && as_node(node_)->is_number();
}
bool TomlValue::is_boolean() const {
  return node_ != nullptr && as_node(node_)->is_boolean();
}

std::size_t TomlValue::size() const {
  if (node_ == nullptr) return 0;
  const toml::array* array = as_node(node_)->as_array();
  if (array == nullptr) reject("found " + type_in_words(*as_node(node_)) + ", expected an array");
  return array->size();
}

TomlValue TomlValue::operator[](std::size_t index) const {
  const toml::array* array = node_ != nullptr ? as_node(node_)->as_array() : nullptr;
  if (array == nullptr || index >= array->size()) reject(fmt::format("has no element {}", index));
  return {state_, array->get(index), node_, fmt::format("{}[{}]", name_, index)};
}

double TomlValue::number() const {
  if (node_ == nullptr) reject("is missing, expected a number");
  const toml::node& node = *as_node(node_);
  if (!node.is_number()) reject("found " + type_in_words(node) + ", expected a number");
  const double value =
      node.is_integer() ? static_cast<double>(node.as_integer()->get()) : node.as_floating_point()->get();
  constexpr double largest = 1e15;
  if (!std::isfinite(value) || std::abs(value) > largest)
    reject(fmt::format("found {}, expected a finite number", value));
  return value;
}

double TomlValue::number(double low, double high) const {
  const double value = number();
  if (value < low || value > high)
    reject(fmt::format("found {}, expected a number from {} to {}", value, low, high));
  return value;
}

double TomlValue::positive() const {
  const double value = number();
  if (value <= 0) reject(fmt::format("found {}, expected a number above 0", value));
  return value;
}

long long TomlValue::integer(long long low, long long high) const {
  const double value = number();
  if (value != std::floor(value) || value < static_cast<double>(low) || value > static_cast<double>(high))
    reject(fmt::format("found {}, expected a whole number from {} to {}", value, low, high));
  return static_cast<long long>(value);
}

bool TomlValue::boolean() const {
  if (!is_boolean()) reject("expected true or false");
  return as_node(node_)->as_boolean()->get();
}

std::string TomlValue::string() const {
  if (node_ == nullptr) reject("is missing, expected a text");
  if (!is_string()) reject("found " + type_in_words(*as_node(node_)) + ", expected a text in quotes");
  return as_node(node_)->as_string()->get();
}

std::string TomlValue::one_of(const std::vector<std::string>& known) const {
  std::string value = string();
  for (const std::string& word : known) {
    if (word == value) return value;
  }
  reject("unknown " + in_quotes(value) + did_you_mean(value, known));
}

std::vector<double> TomlValue::numbers() const {
  if (!is_array()) reject("expected an array of numbers");
  std::vector<double> out;
  for (std::size_t i = 0; i < size(); ++i) out.push_back((*this)[i].number());
  return out;
}

std::vector<double> TomlValue::numbers(std::size_t size) const {
  std::vector<double> out = numbers();
  if (out.size() != size) reject(fmt::format("{} numbers, expected {}", out.size(), size));
  return out;
}

double TomlValue::number_or(std::string_view key, double otherwise) const {
  const TomlValue value = get(key);
  return value ? value.number() : otherwise;
}

bool TomlValue::boolean_or(std::string_view key, bool otherwise) const {
  const TomlValue value = get(key);
  return value ? value.boolean() : otherwise;
}

std::string TomlValue::string_or(std::string_view key, std::string_view otherwise) const {
  const TomlValue value = get(key);
  return value ? value.string() : std::string(otherwise);
}

std::string toml_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string toml_number(double value) {
  std::string out = fmt::format("{}", value);
  if (out.find_first_of(".e") == std::string::npos) out += ".0";  // TOML tells integers from floats
  return out;
}

}  // namespace bpms
