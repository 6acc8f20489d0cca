// XML as a stream of elements that know their place (expat). No entities but XML's own; nesting is limited.
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"

namespace bpms {

struct XmlElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;
  SourceLocation where;
  const std::string* attribute(std::string_view name) const;  // null: absent
};

struct XmlHandler {
  std::function<void(const XmlElement&)> open;
  // `text`: what stands between the tags of an element without children, spaces around it cut off.
  std::function<void(const std::string& name, std::string_view text, const SourceLocation& where)> close;
};

// Errors that the handler throws come out as they are; what is not XML is bad_input where it stands.
void read_xml(const std::string& path, std::string_view text, const XmlHandler& handler);

std::string xml_escaped(std::string_view text);

}  // namespace bpms
