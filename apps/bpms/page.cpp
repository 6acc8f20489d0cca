#include "apps/bpms/verb.h"
#include "core/error.h"

namespace bpms {
std::string html_page(const Json&) {
  throw Error(ErrorKind::bad_input, "this build has no report page (workbench/)");
}
}  // namespace bpms
