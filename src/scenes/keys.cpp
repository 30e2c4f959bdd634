// SPDX-License-Identifier: MIT
#include "scenes/keys.hpp"

namespace jetlag {

namespace {

bool is_value(const std::string& fallback) {
  return !fallback.starts_with("required") && !fallback.starts_with("none");
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

/// A text, and whose it is.
struct Said {
  std::string text;
  std::vector<std::string> by;
};

void say(std::vector<Said>& all, const std::string& text, const std::string& name) {
  const auto known = std::ranges::find(all, text, &Said::text);
  if (known != all.end())
    known->by.push_back(name);
  else
    all.push_back({text, {name}});
}

/// A key of some of the choices. Its default: the same for all; or required, with those that require it.
SceneKey merged_key(const std::string& part, const std::string& name, const std::vector<Choice>& choices) {
  std::vector<Said> values, fallbacks;
  std::vector<std::string> with;
  for (const Choice& choice : choices)
    if (const SceneKey* key = find_key(choice.keys, name)) {
      say(values, key->values, choice.name);
      say(fallbacks, key->fallback, choice.name);
      with.push_back(choice.name);
    }
  const bool of_all = with.size() == choices.size();
  SceneKey key{part + "." + name, "", fallbacks.front().text, of_all ? std::vector<std::string>{} : with};
  for (const auto& [text, by] : values)
    key.values += (key.values.empty() ? "" : "; ") +
                  (of_all && values.size() == 1 ? "" : "with " + quoted_list(by) + ": ") + text;
  const auto required = std::ranges::find(fallbacks, "required", &Said::text);
  if (required != fallbacks.end() && !(of_all && fallbacks.size() == 1))
    key.fallback = "required with " + quoted_list(required->by);
  return key;
}

}  // namespace

std::string quoted_list(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "`" : ", `") + name + "`";
  return list;
}

SceneKey choice(const std::string& key, const std::vector<std::string>& names, const std::string& fallback,
                const std::string& more) {
  return {key, quoted_list(names) + more, fallback, {}, names};
}

SceneKey under(const std::vector<std::string>& names, SceneKey key) {
  key.values = "with " + quoted_list(names) + ": " + key.values;
  if (key.fallback == "required") key.fallback += " with " + quoted_list(names);
  key.with = names;
  return key;
}

SceneKeys merged(const std::string& part, const std::vector<Choice>& choices) {
  SceneKeys all;
  for (const Choice& choice : choices)
    for (const SceneKey& key : choice.keys)
      if (find_key(all, part + "." + key.key) == nullptr) all.push_back(merged_key(part, key.key, choices));
  return all;
}

SceneKeys joined(std::initializer_list<SceneKeys> lists) {
  SceneKeys all;
  for (const SceneKeys& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

std::vector<std::string_view> allowed(const SceneKeys& keys, const std::string& part,
                                      const std::string& chosen) {
  std::vector<std::string_view> names;
  for (const SceneKey& key : keys)
    if (key.key.starts_with(part + ".") && (key.with.empty() || contains(key.with, chosen)))
      names.push_back(std::string_view(key.key).substr(part.size() + 1));
  return names;
}

const SceneKey* find_key(const SceneKeys& keys, const std::string& key) {
  const auto found = std::ranges::find(keys, key, &SceneKey::key);
  return found == keys.end() ? nullptr : &*found;
}

std::string markdown_table(const SceneKeys& keys) {
  std::string table = "| key | values | default |\n|---|---|---|\n";
  for (const SceneKey& key : keys)
    table += "| `" + key.key + "` | " + markdown_cell(key.values) + " | " +
             (is_value(key.fallback) ? "`" + key.fallback + "`" : markdown_cell(key.fallback)) + " |\n";
  return table;
}

std::string markdown_cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped;
}

}  // namespace jetlag
