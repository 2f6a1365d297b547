// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/room.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace calotte::io_detail {

/// An element of an XML document.
struct XmlElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::string text; ///< text of the element itself, without that of its children
  int parent = -1;  ///< index in the document; -1 for the root

  /// The value of an attribute, or `otherwise`.
  std::string attribute(std::string_view key, std::string_view otherwise = {}) const;
};

/// Elements in the order of their start tags; the first is the root.
using XmlDocument = std::vector<XmlElement>;

/// The children of an element. If a name is given, only those of that name.
std::vector<const XmlElement*> children(const XmlDocument& document, const XmlElement& parent,
                                        std::string_view name = {});

/// Parses a document. A document type declaration is refused.
/// \param parts consecutive parts of its text.
/// \param name of the file, for messages.
/// \throws Error parse.
XmlDocument parse_xml(const std::vector<std::string_view>& parts, const std::string& name);

} // namespace calotte::io_detail
