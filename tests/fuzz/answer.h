// What a target accepts of a reader.
#pragma once
#include <cstdlib>
#include <string>

#include "core/error.h"

namespace bpms::fuzz {

// Runs f: the only proper answer to bad input is one line of bad_input that says where in `file`.
template <class F>
void answer(const char* file, const F& f) {
  try {
    f();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::bad_input || error.where().file != file) std::abort();
    if (std::string(error.what()).find('\n') != std::string::npos) std::abort();
  }
}

}  // namespace bpms::fuzz
