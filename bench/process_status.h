// What the system says of this process.
#pragma once
#include <fstream>
#include <string>

namespace bpms {

// A line of /proc/self/status, in MiB.
inline double status_mib(const std::string& key) {
  std::ifstream file("/proc/self/status");
  for (std::string word; file >> word;) {
    double kib = 0;
    if (word == key + ":" && file >> kib) return kib / 1024;
  }
  return 0;
}

}  // namespace bpms
