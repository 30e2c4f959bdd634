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
                           " were read; write {\"header\", \"Symbol\"} in src/scenes/methods");
  return *found;
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

std::string keys(const MethodRecord& record) {
  std::string text =
      markdown_table(joined({{{record.named_by, "`" + record.name + "`", "required"}}, record.keys}));
  for (const std::string& example : record.examples) text += "\n```json\n" + example + "\n```\n";
  return text + "\n";
}

}  // namespace

const MethodRecord& method_record(const std::string& name) {
  const auto found = std::ranges::find(method_records(), name, &MethodRecord::name);
  if (found != method_records().end()) return *found;
  std::string all;
  for (const MethodRecord& record : method_records()) all += (all.empty() ? "" : ", ") + record.name;
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

std::string markdown(const MethodRecord& record) {
  std::string text = "# " + record.name + "\n\n" + record.what + ".\n\n## Equations\n\n" +
                     equations(record.declared) + "## When to use it\n\n" + record.when +
                     "\n\n## In a scene\n\n" + keys(record) + "## What proves it\n\n";
  for (const Proof& proof : record.proofs)
    text +=
        "- `" + proof.number + "`: " + proof.claim + ". `" + proof.test + "` in `tests/" + proof.file + "`\n";
  text += "\n## Source\n\n";
  for (const std::string& source : sources_of(record.declared)) text += "- " + source + "\n";
  return text + "\nWhat stands in square brackets is in the list of sources, include/jetlag/sources.md.\n";
}

std::string markdown_index(const std::vector<MethodRecord>& records) {
  std::string text =
      "# Methods\n\nOne page for each, as `jetlag methods NAME` prints it; [scene.md](scene.md) says what a "
      "scene file may hold beside.\n\n| method | what it is | when "
      "to use "
      "it |\n|---|---|---|\n";
  for (const MethodRecord& record : records)
    text += "| [" + record.name + "](" + record.name + ".md) | " + markdown_cell(record.what) + " | " +
            markdown_cell(record.when) + " |\n";
  return text;
}

}  // namespace jetlag
