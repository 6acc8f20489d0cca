#include "plant/exchange/xml.h"

#include <expat.h>

#include <exception>
#include <limits>
#include <memory>

namespace bpms {

const std::string* XmlElement::attribute(std::string_view wanted) const {
  for (const auto& one : attributes)
    if (one.first == wanted) return &one.second;
  return nullptr;
}

namespace {

constexpr int deepest_element = 10'000;

struct XmlRun {
  XML_Parser parser = nullptr;
  const std::string& file;
  const XmlHandler& handler;
  std::string text;  // of the element that is open and has had no children
  SourceLocation text_where;
  int depth = 0;
  std::exception_ptr error;

  SourceLocation here() const {
    return {file, static_cast<int>(XML_GetCurrentLineNumber(parser)),
            static_cast<int>(XML_GetCurrentColumnNumber(parser)) + 1};
  }
  // No exception may cross expat's own frames.
  template <class Call>
  void guarded(const Call& call) {
    if (error) return;
    try {
      call();
    } catch (...) {
      error = std::current_exception();
      XML_StopParser(parser, XML_FALSE);
    }
  }
};

void open_xml(void* user, const XML_Char* name, const XML_Char** attributes) {
  auto& run = *static_cast<XmlRun*>(user);
  run.guarded([&] {
    XmlElement element{name, {}, run.here()};
    if (++run.depth > deepest_element)
      bad_input(element.where, "elements are nested more than {} deep", deepest_element);
    for (const XML_Char** at = attributes; *at != nullptr; at += 2)
      element.attributes.emplace_back(at[0], at[1]);
    run.text.clear();
    run.text_where = element.where;
    run.handler.open(element);
  });
}

void close_xml(void* user, const XML_Char* name) {
  auto& run = *static_cast<XmlRun*>(user);
  run.guarded([&] {
    --run.depth;
    std::string_view text = run.text;
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    text = first == std::string_view::npos ? std::string_view{}
                                           : text.substr(first, text.find_last_not_of(" \t\r\n") + 1 - first);
    run.handler.close(name, text, run.text_where);
    run.text.clear();
  });
}

void add_xml_text(void* user, const XML_Char* text, int length) {
  auto& run = *static_cast<XmlRun*>(user);
  run.guarded([&] {
    if (run.text.empty()) run.text_where = run.here();
    run.text.append(text, static_cast<std::size_t>(length));
  });
}

void refuse_entity(void* user, const XML_Char* name, int, const XML_Char*, int, const XML_Char*,
                   const XML_Char*, const XML_Char*, const XML_Char*) {
  auto& run = *static_cast<XmlRun*>(user);
  run.guarded([&] {
    bad_input(run.here(), "the entity {} is declared; files with entities are not read", in_quotes(name));
  });
}

}  // namespace

void read_xml(const std::string& path, std::string_view text, const XmlHandler& handler) {
  const std::unique_ptr<std::remove_pointer_t<XML_Parser>, void (*)(XML_Parser)> parser(
      XML_ParserCreate(nullptr), &XML_ParserFree);
  if (!parser) throw std::bad_alloc();
  XmlRun run{parser.get(), path, handler, {}, {path}, 0, nullptr};
  XML_SetUserData(parser.get(), &run);
  XML_SetElementHandler(parser.get(), open_xml, close_xml);
  XML_SetCharacterDataHandler(parser.get(), add_xml_text);
  XML_SetEntityDeclHandler(parser.get(), refuse_entity);
  constexpr std::size_t piece = std::size_t{1} << 20;
  for (std::size_t at = 0;; at += piece) {
    const std::string_view part = text.substr(std::min(at, text.size()), piece);
    const bool last = at + piece >= text.size();
    const XML_Status status =
        XML_Parse(parser.get(), part.data(), static_cast<int>(part.size()), last ? XML_TRUE : XML_FALSE);
    if (run.error) std::rethrow_exception(run.error);
    if (status != XML_STATUS_OK)
      bad_input(run.here(), "not well-formed XML: {}", XML_ErrorString(XML_GetErrorCode(parser.get())));
    if (last) return;
  }
}

std::string xml_escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

}  // namespace bpms
