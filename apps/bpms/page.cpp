#include <string_view>

#include "apps/bpms/verb.h"
#include "core/error.h"

extern "C" {
extern const char bpms_page_begin[];
extern const char bpms_page_end[];
extern const char bpms_viewer_begin[];
extern const char bpms_viewer_end[];
}

namespace bpms {
namespace {

std::string filled(std::string_view page, const Json& document) {
  static constexpr std::string_view token = "__BPMS_DATA__";
  const std::size_t at = page.find(token);
  if (at == std::string_view::npos) throw Error(ErrorKind::internal, "the page has no place for data");
  std::string data;
  for (const char c : document.dump(
           -1, ' ', false,
           Json::error_handler_t::replace)) {  // a '<' inside a text must not end the script element
    if (c == '<') {
      data += "\\u003c";
    } else {
      data += c;
    }
  }
  std::string out(page.substr(0, at));
  out += data;
  out += page.substr(at + token.size());
  return out;
}

std::string_view bytes(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace

std::string html_page(const Json& document) {
  return filled(bytes(bpms_page_begin, bpms_page_end), document);
}

std::string viewer_page(const Json& document) {
  return filled(bytes(bpms_viewer_begin, bpms_viewer_end), document);
}

}  // namespace bpms
