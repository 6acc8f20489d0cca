// Errors of every stage: one exception with a kind, a place and a one-line message.
#pragma once
#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace bpms {

enum class ErrorKind {
  internal,          // a bug in bpms                                        exit 1
  bad_input,         // the user's file or command line is wrong             exit 2
  missing_resource,  // missing or unwritable file, memory or disk limit     exit 3
  device,            // missing or failing instrument                        exit 3
  numeric,           // did not converge, rank deficient                     exit 4
  refused,           // a test that says no on sound input                   exit 5
  interrupted,       // Ctrl-C                                               exit 130
};

int exit_code(ErrorKind kind);

// A place in a text: lines and columns count from 1; 0 = not known. Columns count bytes.
struct SourceLocation {
  std::string file;
  int line = 0;
  int column = 0;
  std::string str() const;  // "file:line:column", as far as known
};

class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, SourceLocation where, const std::string& message);
  Error(ErrorKind kind, const std::string& message) : Error(kind, SourceLocation{}, message) {}
  ErrorKind kind() const { return kind_; }
  const SourceLocation& where() const { return where_; }
  const std::string& message() const { return message_; }  // without the place; what() has both

 private:
  ErrorKind kind_;
  SourceLocation where_;
  std::string message_;
};

template <class... Args>
[[noreturn]] void fail(ErrorKind kind, const SourceLocation& where, fmt::format_string<Args...> format,
                       Args&&... args) {
  throw Error(kind, where, fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
[[noreturn]] void bad_input(const SourceLocation& where, fmt::format_string<Args...> format, Args&&... args) {
  throw Error(ErrorKind::bad_input, where, fmt::format(format, std::forward<Args>(args)...));
}

// What the user typed, made safe to print in one line: control bytes escaped, long text cut.
std::string in_quotes(std::string_view text);

}  // namespace bpms
