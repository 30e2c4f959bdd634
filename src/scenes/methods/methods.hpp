// SPDX-License-Identifier: MIT
#pragma once
// A page for every method that a scene can name. The register (method_register_*.cpp) says what no header does: when
// to use it, its keys, what proves it. Its equations and sources are read from the comments of the headers when the
// library is built (.cmake/method_docs.cmake): the page has them as the code has.

#include <string>
#include <vector>

namespace jetlag {

/// What a header declares; header: below include/jetlag, symbol: of a class or a function.
struct Declaration {
  std::string header, symbol;
};

/// A key of a scene: its values with unit and range; and its default: a value, or "required ..", or "none ..".
struct SceneKey {
  std::string key, values, fallback;
};

/// What a test (Suite.Name) in a file below tests shows; number: as it stands in that test.
struct Proof {
  std::string number, claim, test, file;
};

struct MethodPage {
  std::string name;                   // in a scene
  std::string what;                   // one line
  std::string when;                   // to use it
  std::vector<Declaration> declared;  // the method itself, then what it stands on
  std::vector<SceneKey> keys;         // beside that of its name
  std::vector<std::string> examples;  // parts of scenes, in JSON
  std::vector<Proof> proofs;
  std::string named_by = "integrator.type";
};

/// The register: all pages.
const std::vector<MethodPage>& method_pages();

/// The page of a method. Throws std::invalid_argument naming those that exist.
const MethodPage& method_page(const std::string& name);

/// The page in Markdown, and a table of all with links to NAME.md.
std::string markdown(const MethodPage& page);
std::string markdown_index(const std::vector<MethodPage>& pages);

/// The comment on top of the header and the docstring of the symbol, line by line without their slashes.
struct HeaderText {
  std::string header, symbol, top, docstring;
};
const std::vector<HeaderText>& header_texts();

/// What the comments of these declarations say of sources: each "Source: .." up to the end of its paragraph.
std::vector<std::string> sources_of(const std::vector<Declaration>& declared);

}  // namespace jetlag
