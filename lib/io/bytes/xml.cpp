// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/xml.h"

#include "io/bytes/file_error.h"

#include <expat.h>

#include <algorithm>
#include <exception>
#include <memory>

namespace calotte::io_detail {
namespace {

/// Size of the pieces that the parser receives.
constexpr std::size_t parse_bytes = std::size_t{1} << 20;
/// Maximum size in bytes of a tag or a comment. The parser scans each from its start again with
/// every piece of the text.
constexpr std::int64_t longest_tag = 2 * parse_bytes;
constexpr std::size_t most_elements = 20'000; ///< so that memory stays in proportion to the file

/// Collects what the parser reports.
struct Collector {
  XML_Parser parser = nullptr;
  XmlDocument document = {};
  int open = -1; ///< the innermost element that is open
  std::exception_ptr thrown = nullptr;
  const char* refused = nullptr; ///< why the parser was stopped

  /// Runs a step of a callback: no exception leaves it through the parser's frames.
  template <class Step> void guard(const Step& step) {
    try {
      step();
    } catch (...) {
      thrown = std::current_exception();
      XML_StopParser(parser, XML_FALSE);
    }
  }

  void refuse(const char* reason) {
    refused = reason;
    XML_StopParser(parser, XML_FALSE);
  }

  void start(const char* name, const char** attributes) {
    if (document.size() == most_elements)
      return refuse("too many elements");
    XmlElement element{.name = name, .attributes = {}, .text = {}, .parent = open};
    for (; *attributes != nullptr; attributes += 2)
      element.attributes.emplace_back(attributes[0], attributes[1]);
    open = static_cast<int>(document.size());
    document.push_back(std::move(element));
  }

  void end() { open = document[static_cast<std::size_t>(open)].parent; }

  void text(const char* begin, int size) {
    if (open >= 0)
      document[static_cast<std::size_t>(open)].text.append(begin, static_cast<std::size_t>(size));
  }
};

Collector& of(void* collector) { return *static_cast<Collector*>(collector); }

void set_callbacks(Collector& collector) {
  XML_SetUserData(collector.parser, &collector);
  XML_SetElementHandler(
      collector.parser,
      [](void* user, const char* name, const char** attributes) {
        of(user).guard([&] { of(user).start(name, attributes); });
      },
      [](void* user, const char*) { of(user).end(); });
  XML_SetCharacterDataHandler(collector.parser, [](void* user, const char* begin, int size) {
    of(user).guard([&] { of(user).text(begin, size); });
  });
  XML_SetStartDoctypeDeclHandler(
      collector.parser, [](void* user, const char*, const char*, const char*, int) {
        of(user).refuse("a document type declaration, which no mesh file needs");
      });
}

[[noreturn]] void fail(const Collector& collector, const std::string& name) {
  if (collector.thrown)
    std::rethrow_exception(collector.thrown);
  fail_damaged(name, "the XML is not well-formed at line {} ({})",
               XML_GetCurrentLineNumber(collector.parser),
               collector.refused != nullptr ? collector.refused
                                            : XML_ErrorString(XML_GetErrorCode(collector.parser)));
}

} // namespace

std::string XmlElement::attribute(std::string_view key, std::string_view otherwise) const {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [&](const auto& a) { return a.first == key; });
  return std::string(found == attributes.end() ? otherwise : std::string_view(found->second));
}

std::vector<const XmlElement*> children(const XmlDocument& document, const XmlElement& parent,
                                        std::string_view name) {
  const auto index = static_cast<int>(&parent - document.data());
  std::vector<const XmlElement*> found;
  for (const XmlElement& element : document)
    if (element.parent == index && (name.empty() || element.name == name))
      found.push_back(&element);
  return found;
}

XmlDocument parse_xml(const std::vector<std::string_view>& parts, const std::string& name) {
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(
      XML_ParserCreate(nullptr), &XML_ParserFree);
  if (!parser)
    throw std::bad_alloc();
  Collector collector{.parser = parser.get()};
  set_callbacks(collector);
  std::int64_t fed = 0; // bytes
  const auto parse = [&](std::string_view text, bool last) {
    if (XML_Parse(parser.get(), text.data(), static_cast<int>(text.size()), last ? 1 : 0) ==
        XML_STATUS_ERROR)
      fail(collector, name);
    fed += std::ssize(text);
    if (!last && fed - XML_GetCurrentByteIndex(parser.get()) > longest_tag) {
      collector.refused = "a tag longer than 2 MiB";
      fail(collector, name);
    }
  };
  for (const std::string_view part : parts)
    for (std::size_t begin = 0; begin < part.size(); begin += parse_bytes)
      parse(part.substr(begin, parse_bytes), false);
  parse({}, true);
  return std::move(collector.document);
}

} // namespace calotte::io_detail
