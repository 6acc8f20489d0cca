#include "core/error.h"

namespace bpms {

int exit_code(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::internal:
      return 1;
    case ErrorKind::bad_input:
      return 2;
    case ErrorKind::missing_resource:
    case ErrorKind::device:
      return 3;
    case ErrorKind::numeric:
      return 4;
    case ErrorKind::refused:
      return 5;
    case ErrorKind::interrupted:
      return 130;
  }
  return 1;
}

std::string SourceLocation::str() const {
  std::string out = file;
  if (line > 0) {
    out += fmt::format(":{}", line);
    if (column > 0) out += fmt::format(":{}", column);
  }
  return out;
}

namespace {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) {
      out += fmt::format("\\x{:02x}", byte);
    } else {
      out += c;
    }
  }
  return out;
}

// One line whatever stands in it: names in a message may come from a file.
std::string located(const SourceLocation& where, const std::string& message) {
  return escaped(where.file.empty() ? message : where.str() + ": " + message);
}

}  // namespace

Error::Error(ErrorKind kind, SourceLocation where, const std::string& message)
    : std::runtime_error(located(where, message)),
      kind_(kind),
      where_(std::move(where)),
      message_(escaped(message)) {}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string out = "'" + escaped(text.substr(0, longest));
  if (text.size() > longest) out += "...";
  return out + "'";
}

}  // namespace bpms
