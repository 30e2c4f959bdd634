// SPDX-License-Identifier: MIT
#pragma once
// The keys of a scene: said once, for the reader that refuses others and for the pages that list them.

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace jetlag {

/// A key ("part.name"): its values with unit and range; and its default: a value, or "required ..", or "none ..".
struct SceneKey {
  std::string key, values, fallback;
  std::vector<std::string> with{};   // what "type" (of an integrator "law") must be for it; empty: anything
  std::vector<std::string> names{};  // of a key that chooses from them: a type or a law
};

using SceneKeys = std::vector<SceneKey>;

/// "`a`, `b`"
std::string quoted_list(const std::vector<std::string>& names);

/// A key that chooses from names; more: what else is to be said of them.
SceneKey choice(const std::string& key, const std::vector<std::string>& names, const std::string& fallback,
                const std::string& more = "");

/// A key that goes with some names of a choice only, which is said before its values.
SceneKey under(const std::vector<std::string>& names, SceneKey key);

/// One name of a choice, with keys of its own, without their part.
struct Choice {
  std::string name;
  SceneKeys keys;
};
/// The keys of all choices, each once, in the order of their first appearance; what differs is said name by name.
SceneKeys merged(const std::string& part, const std::vector<Choice>& choices);

/// One list after the other.
SceneKeys joined(std::initializer_list<SceneKeys> lists);

/// The names without their part of the keys of `part` that may stand beside `chosen`.
std::vector<std::string_view> allowed(const SceneKeys& keys, const std::string& part,
                                      const std::string& chosen = "");

/// nullptr where it is not in the list.
const SceneKey* find_key(const SceneKeys& keys, const std::string& key);

/// A table in Markdown.
std::string markdown_table(const SceneKeys& keys);
/// What stands in a cell of a table.
std::string markdown_cell(const std::string& text);

}  // namespace jetlag
