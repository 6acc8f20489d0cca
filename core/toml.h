// TOML documents whose values know their line and column, and whose unknown keys are errors.
// A reader asks for the keys it knows; finish() then reports the first key that nobody asked for, with the
// nearest one that somebody did. toml++ stays behind this header.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace bpms {

class TomlValue;

class TomlDocument {
 public:
  static TomlDocument read(const std::string& path);
  static TomlDocument parse(const std::string& path, std::string_view text);
  TomlValue root() const;
  const std::string& path() const;
  // bad_input at the first key in the whole document that was not asked for.
  void finish() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
  friend class TomlValue;
};

// A value in a document: table, array, string, number, boolean; or nothing (operator bool is false).
class TomlValue {
 public:
  explicit operator bool() const { return node_ != nullptr; }
  SourceLocation where() const;  // of this value; of the table it was looked for in, when absent
  const std::string& name() const { return name_; }  // dotted path, "sensors[0].vza_deg"
  std::string file_relative(
      std::string_view path) const;  // a path written in the file, relative to the file's folder

  // Tables. get() marks the key as known, present or not.
  TomlValue get(std::string_view key) const;
  TomlValue require(std::string_view key) const;  // or bad_input "missing key"
  bool has(std::string_view key) const;           // marks the key as known
  std::vector<std::string> keys() const;          // of a table with free names ([materials.X]); marks none
  bool is_table() const, is_array() const, is_string() const, is_number() const, is_boolean() const;

  // Arrays (also arrays of tables).
  std::size_t size() const;
  TomlValue operator[](std::size_t index) const;

  // Leaves; a value of another type, a NaN or an infinity is located bad_input.
  double number() const;
  double number(double low, double high) const;  // and inside [low, high]
  double positive() const;                       // > 0
  long long integer(long long low, long long high) const;
  bool boolean() const;
  std::string string() const;
  std::string one_of(const std::vector<std::string>& known) const;
  std::vector<double> numbers() const;  // array of numbers
  std::vector<double> numbers(std::size_t size) const;

  // The same with a default where the key is absent.
  double number_or(std::string_view key, double otherwise) const;
  bool boolean_or(std::string_view key, bool otherwise) const;
  std::string string_or(std::string_view key, std::string_view otherwise) const;

  // bad_input at this value; `message` in words ("expected ...").
  [[noreturn]] void reject(const std::string& message) const;
  // The same for a table that lacks one of several keys, once all the keys it may have were asked for: when
  // it holds one that was not, that is the likelier mistake and is named instead.
  [[noreturn]] void reject_choice(const std::string& message) const;

 private:
  friend class TomlDocument;
  TomlValue(std::shared_ptr<TomlDocument::State> state, const void* node, const void* parent,
            std::string name);
  std::shared_ptr<TomlDocument::State> state_;
  const void* node_ = nullptr;    // toml::node
  const void* parent_ = nullptr;  // where an absent key was looked for
  std::string name_;
};

// A string in TOML's basic form, with quotes and escapes; a number that reads back as the same double.
std::string toml_string(std::string_view text);
std::string toml_number(double value);

}  // namespace bpms
