// SPDX-License-Identifier: MIT
#include "scenes/methods/methods.hpp"

#include <algorithm>
#include <set>
#include <sstream>
#include <stdexcept>

namespace jetlag {

namespace {

const HeaderText& text_of(const Declaration& declared) {
  const auto found = std::ranges::find_if(header_texts(), [&](const HeaderText& text) {
    return text.header == declared.header && text.symbol == declared.symbol;
  });
  if (found == header_texts().end())
    throw std::logic_error("no comments of " + declared.symbol + " in " + declared.header +
                           " were read; write {\"header\", \"Symbol\"} in method_register_*.cpp");
  return *found;
}

/// A cell of a table.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped;
}

bool is_value(const std::string& fallback) {
  return !fallback.starts_with("required") && !fallback.starts_with("none");
}

/// The comments as they stand, those on top of a header once.
std::string equations(const std::vector<Declaration>& declared) {
  std::string page;
  std::set<std::string> shown;
  for (const Declaration& one : declared) {
    const HeaderText& text = text_of(one);
    const bool with_top = shown.insert(text.header).second;
    page += "From `include/jetlag/" + text.header + "`, `" + text.symbol + "`:\n\n```text\n";
    if (with_top) page += text.top;
    if (with_top && !text.docstring.empty()) page += "\n";
    page += text.docstring + "```\n\n";
  }
  return page;
}

std::string keys(const MethodPage& page) {
  std::string table = "| key | values | default |\n|---|---|---|\n| `" + page.named_by + "` | `" + page.name +
                      "` | required |\n";
  for (const SceneKey& key : page.keys)
    table += "| `" + key.key + "` | " + cell(key.values) + " | " +
             (is_value(key.fallback) ? "`" + key.fallback + "`" : cell(key.fallback)) + " |\n";
  for (const std::string& example : page.examples) table += "\n```json\n" + example + "\n```\n";
  return table + "\n";
}

}  // namespace

const MethodPage& method_page(const std::string& name) {
  const auto found = std::ranges::find(method_pages(), name, &MethodPage::name);
  if (found != method_pages().end()) return *found;
  std::string all;
  for (const MethodPage& page : method_pages()) all += (all.empty() ? "" : ", ") + page.name;
  throw std::invalid_argument("methods: got \"" + name + "\"; must be one of " + all);
}

std::vector<std::string> sources_of(const std::vector<Declaration>& declared) {
  std::vector<std::string> sources;
  std::set<std::string> seen;
  for (const Declaration& one : declared) {
    const HeaderText& text = text_of(one);
    std::istringstream lines((seen.insert(text.header).second ? text.top : "") + "\n" + text.docstring);
    bool inside = false;
    for (std::string line; std::getline(lines, line);) {
      if (line.empty() || line.starts_with("Throws")) inside = false;
      const auto source = std::min(line.find("Source: "), line.find("Sources: "));
      if (source != std::string::npos) {
        sources.push_back(line.substr(line.find(": ", source) + 2));
        inside = true;
      } else if (inside) {
        sources.back() += " " + line;
      }
    }
  }
  return sources;
}

std::string markdown(const MethodPage& page) {
  std::string text = "# " + page.name + "\n\n" + page.what + ".\n\n## Equations\n\n" +
                     equations(page.declared) + "## When to use it\n\n" + page.when +
                     "\n\n## In a scene\n\n" + keys(page) + "## What proves it\n\n";
  for (const Proof& proof : page.proofs)
    text +=
        "- `" + proof.number + "`: " + proof.claim + ". `" + proof.test + "` in `tests/" + proof.file + "`\n";
  text += "\n## Source\n\n";
  for (const std::string& source : sources_of(page.declared)) text += "- " + source + "\n";
  return text + "\nWhat stands in square brackets is in the list of sources of README.md.\n";
}

std::string markdown_index(const std::vector<MethodPage>& pages) {
  std::string text =
      "# Methods\n\nOne page for each, as `jetlag methods NAME` prints it.\n\n| method | what it is | when "
      "to use "
      "it |\n|---|---|---|\n";
  for (const MethodPage& page : pages)
    text +=
        "| [" + page.name + "](" + page.name + ".md) | " + cell(page.what) + " | " + cell(page.when) + " |\n";
  return text;
}

}  // namespace jetlag
