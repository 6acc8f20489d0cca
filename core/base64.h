#pragma once
#include <string>
#include <string_view>

namespace bpms {
std::string base64(std::string_view bytes);
// "data:image/png;base64,..." of a file, the type told by its first bytes (PNG or JPEG).
std::string image_data_uri(const std::string& path);
}  // namespace bpms
