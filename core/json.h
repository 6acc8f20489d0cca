// Reports are JSON documents whose keys keep their order; a number that is not finite is written as null.
#pragma once
#include <nlohmann/json.hpp>

namespace bpms {
using Json = nlohmann::ordered_json;
}
