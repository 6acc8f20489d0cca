// Plant texts of tests: read under the name x.bpms, or refused.
#pragma once
#include <string>

#include "plant/plant.h"
#include "tests/data.h"

namespace bpms::test {
inline Plant plant_of(const std::string& text, bool lenient = false) {
  return parse_plant("x.bpms", text, {lenient});
}
}  // namespace bpms::test

#define EXPECT_REFUSED(text, part) BPMS_EXPECT_ERROR(bpms::test::plant_of(text), bad_input, part)
