#include <string_view>

#include "apps/bpms/verb.h"
#include "core/error.h"

extern "C" {
extern const char bpms_page_begin[];
extern const char bpms_page_end[];
}

namespace bpms {

std::string html_page(const Json& document) {
  static constexpr std::string_view token = "__BPMS_DATA__";
  const std::string_view page(bpms_page_begin, static_cast<std::size_t>(bpms_page_end - bpms_page_begin));
  const std::size_t at = page.find(token);
  if (at == std::string_view::npos) throw Error(ErrorKind::internal, "the report page has no place for data");
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

}  // namespace bpms
