// What a program prints, errors too.
#pragma once
#include <cstdio>
#include <string>

namespace bpms::test {

inline std::string said_by(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::string out;
  for (int c = 0; (c = std::fgetc(pipe)) != EOF;) out += static_cast<char>(c);
  pclose(pipe);
  return out;
}

}  // namespace bpms::test
