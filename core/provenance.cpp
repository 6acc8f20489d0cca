#include "core/provenance.h"

#include <fmt/format.h>
#include <openssl/sha.h>
#include <algorithm>

#include <array>

#include "core/text.h"
#include "core/version.h"

namespace bpms {

std::string version() {
  return BPMS_VERSION;
}

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
  SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), digest.data());
  std::string out;
  for (const unsigned char byte : digest) out += fmt::format("{:02x}", byte);
  return out;
}

void Provenance::add_input(const std::string& path) {
  const auto is_path = [&](const Input& input) { return input.path == path; };
  if (std::ranges::any_of(inputs, is_path)) return;  // what several files include
  inputs.push_back({path, bpms::sha256(read_file(path))});
}

Json Provenance::json() const {
  Json out{{"version", version()},
           {"command", command},
           {"seed", seed ? Json(*seed) : Json()},
           {"inputs", Json::array()}};
  for (const Input& input : inputs) out["inputs"].push_back({{"path", input.path}, {"sha256", input.sha256}});
  return out;
}

}  // namespace bpms
