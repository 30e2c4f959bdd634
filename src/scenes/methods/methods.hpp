// SPDX-License-Identifier: MIT
#pragma once
// The register of methods, and a page for each. Equations and sources are read from the comments of the headers when the
// library is built (.cmake/method_docs.cmake): the page has them as the code has.

#include <string>
#include <vector>

#include "scenes/methods/record.hpp"

namespace jetlag {

/// The register.
const std::vector<MethodRecord>& method_records();

/// The record of a method. Throws std::invalid_argument naming those that exist.
const MethodRecord& method_record(const std::string& name);

/// Its page in Markdown, and a table of all with links to NAME.md.
std::string markdown(const MethodRecord& record);
std::string markdown_index(const std::vector<MethodRecord>& records);

/// The comment on top of the header and the docstring of the symbol, line by line without their slashes.
struct HeaderText {
  std::string header, symbol, top, docstring;
};
const std::vector<HeaderText>& header_texts();

/// What the comments of these declarations say of sources: each "Source: .." up to the end of its paragraph.
std::vector<std::string> sources_of(const std::vector<Declaration>& declared);

}  // namespace jetlag
