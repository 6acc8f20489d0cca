// The kinds of files that `bpms check` recognises. To add one: a line in the table of verb_check.cpp.
#pragma once
#include <string>
#include <string_view>

namespace bpms {
struct FileKind {
  std::string_view name;                                              // "vectors.csv"
  bool (*recognise)(const std::string& path, std::string_view head);  // by name and the first 4 KiB
  std::string (*check)(const std::string& path);                      // reads it; a line about what it holds
};
}  // namespace bpms
