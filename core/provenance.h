// What a result was made from: program version, command line, seed, hashes of the inputs.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/json.h"

namespace bpms {

std::string version();
std::string sha256(std::string_view bytes);  // 64 hexadecimal digits

struct Provenance {
  std::string command;  // as typed, joined by spaces
  std::optional<std::uint64_t> seed;
  struct Input {
    std::string path;
    std::string sha256;
  };
  std::vector<Input> inputs;
  void add_input(const std::string& path);  // reads and hashes the file; a second time: nothing
  Json json() const;                        // {version, command, seed, inputs:[{path, sha256}]}
};

}  // namespace bpms
