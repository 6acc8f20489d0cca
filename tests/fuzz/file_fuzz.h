// For readers that take a path: the bytes as a file.
#pragma once
#include <unistd.h>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "core/error.h"

namespace bpms::fuzz {

// Runs f on the path of a file with these bytes; an answer as in answer.h, an empty file being one too.
template <class F>
void answer_of_file(const char* data, std::size_t size, const char* ending, const F& f) {
  static const std::string path = "/tmp/bpms_fuzz_" + std::to_string(getpid()) + ending;
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr || std::fwrite(data, 1, size, file) != size || std::fclose(file) != 0) std::exit(1);
  try {
    f(path);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::bad_input || error.where().file != path) std::abort();
    if (std::string(error.what()).find('\n') != std::string::npos) std::abort();
  }
}

}  // namespace bpms::fuzz
