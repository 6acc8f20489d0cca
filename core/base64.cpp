#include "core/base64.h"

#include <openssl/evp.h>

#include "core/text.h"

namespace bpms {

std::string base64(std::string_view bytes) {
  std::string out(4 * ((bytes.size() + 2) / 3) + 1, '\0');
  const int length =
      EVP_EncodeBlock(reinterpret_cast<unsigned char*>(out.data()),
                      reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<int>(bytes.size()));
  out.resize(static_cast<std::size_t>(length));
  return out;
}

std::string image_data_uri(const std::string& path) {
  const std::string bytes = read_file(path);
  const bool png = bytes.starts_with("\x89PNG");
  if (!png && !bytes.starts_with("\xff\xd8")) bad_input({path}, "not a PNG or JPEG image");
  return std::string("data:image/") + (png ? "png" : "jpeg") + ";base64," + base64(bytes);
}

}  // namespace bpms
