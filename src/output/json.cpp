// SPDX-License-Identifier: MIT
// Strings are nlohmann's; numbers are ours, because its own are not always the shortest, and "-0" would lose its sign.
#include "output/json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "jetlag/base/text.hpp"

namespace jetlag::json {

namespace {

std::string joined(const std::vector<std::string>& items, const std::string& separator) {
  std::string text;
  for (const std::string& item : items) text += (text.empty() ? "" : separator) + item;
  return text;
}

/// Items between brackets, each on a line of its own.
std::string lines(const char* open, const std::vector<std::string>& items, const char* close, int indent) {
  const std::string margin = "\n" + std::string(indent, ' ');
  return items.empty() ? std::string(open) + close
                       : open + (margin + "  ") + joined(items, "," + margin + "  ") + margin + close;
}

std::vector<std::string> named(const Members& members) {
  std::vector<std::string> items;
  for (const auto& [name, of_name] : members) items.push_back(value(name) + ": " + of_name);
  return items;
}

}  // namespace

std::string value(double x) {
  if (!std::isfinite(x)) return "null";
  const std::string text = number(x);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string value(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string object(const Members& members) { return "{" + joined(named(members), ", ") + "}"; }
std::string object(const Members& members, int indent) { return lines("{", named(members), "}", indent); }

std::string list(const std::vector<std::string>& items) { return "[" + joined(items, ", ") + "]"; }
std::string list(const std::vector<std::string>& items, int indent) { return lines("[", items, "]", indent); }

}  // namespace jetlag::json
