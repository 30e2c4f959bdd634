// SPDX-License-Identifier: MIT
#include "scenes/reader.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "jetlag/scenes/error.hpp"

namespace jetlag {

namespace {

/// "a, b or c"
template <class Names>
std::string listed(const Names& names) {
  std::string text;
  std::size_t i = 0;
  for (const auto& name : names) {
    text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + std::string(name);
    ++i;
  }
  return text;
}

template <class T>
Json json_of(const T& value) {
  return value;
}
Json json_of(const JsonText& json) { return parsed(json.text, json.text); }

}  // namespace

std::string shortened(const std::string& value) {
  return value.size() <= 60 ? value : value.substr(0, 57) + "...";
}

bool Value::is_string() const { return json_->is_string(); }
bool Value::is_array() const { return json_->is_array(); }
bool Value::is_object() const { return json_->is_object(); }
bool Value::is_number() const { return json_->is_number(); }

void Value::refuse(const std::string& allowed) const {
  throw SceneError(path_ + ": got " + shortened(dumped(*json_)) + "; must be " + allowed);
}

const Value& Value::only(const std::vector<std::string_view>& keys) const {
  if (!json_->is_object()) refuse("an object with the keys " + listed(keys));
  for (const auto& [key, value] : json_->items())
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      throw SceneError((path_.empty() ? key : path_ + "." + key) + ": unknown key (its value is " +
                       shortened(dumped(value)) + "); allowed here: " + listed(keys));
  // Room for all keys: values of this object stay where they are when a missing one is put in.
  json_->get_ref<Json::object_t&>().reserve(keys.size());
  return *this;
}

bool Value::has(const std::string& key) const { return json_->is_object() && json_->contains(key); }

Value Value::at(const std::string& key) const {
  const std::string path = path_.empty() ? key : path_ + "." + key;
  if (!has(key)) throw SceneError(path + ": is missing");
  return {(*json_)[key], path};
}

std::optional<Value> Value::find(const std::string& key) const {
  return has(key) ? std::optional(at(key)) : std::nullopt;
}

Value Value::at(const std::string& key, const Fallback& fallback) const {
  if (!has(key)) (*json_)[key] = std::visit([](const auto& value) { return json_of(value); }, fallback);
  return at(key);
}

void Value::replace(const std::string& text) const { *json_ = text; }

std::size_t Value::size() const {
  if (!json_->is_array()) refuse("an array");
  return json_->size();
}

Value Value::at(std::size_t i) const { return {(*json_)[i], path_ + "[" + std::to_string(i) + "]"}; }

double Value::number(const Range& range) const {
  if (!json_->is_number()) refuse(range.words);
  const double x = json_->get<double>();
  if (!std::isfinite(x) || !range.contains(x)) refuse(range.words);
  return x;
}

/// Other programs write whole numbers with a point, as 2.0 or 1e3; up to 2^53 that leaves no doubt which one it is.
std::optional<std::int64_t> Value::written_with_a_point() const {
  if (!json_->is_number_float()) return {};
  const double x = json_->get<double>();
  if (x != std::floor(x) || std::abs(x) > 0x1p53) return {};
  return static_cast<std::int64_t>(x);
}

std::int64_t Value::integer(std::int64_t low, std::int64_t high) const {
  const std::string allowed = "a whole number from " + std::to_string(low) + " to " + std::to_string(high);
  if (const auto x = written_with_a_point(); x && low <= *x && *x <= high) return *x;
  if (!json_->is_number_integer()) refuse(allowed);
  if (json_->is_number_unsigned() && json_->get<std::uint64_t>() > static_cast<std::uint64_t>(high))
    refuse(allowed);
  const auto x = json_->get<std::int64_t>();
  if (x < low || x > high) refuse(allowed);
  return x;
}

std::uint64_t Value::seed() const {
  if (const auto x = written_with_a_point(); x && *x >= 0) return static_cast<std::uint64_t>(*x);
  const bool whole =
      json_->is_number_unsigned() || (json_->is_number_integer() && json_->get<std::int64_t>() >= 0);
  if (!whole) refuse("a whole number from 0 to 18446744073709551615");
  return json_->get<std::uint64_t>();
}

bool Value::boolean() const {
  if (!json_->is_boolean()) refuse("true or false");
  return json_->get<bool>();
}

std::string Value::text() const {
  if (!json_->is_string()) refuse("a string");
  return json_->get<std::string>();
}

std::string Value::one_of(const std::vector<std::string>& names) const {
  if (!json_->is_string() || std::find(names.begin(), names.end(), json_->get<std::string>()) == names.end())
    refuse(listed(names));
  return json_->get<std::string>();
}

std::vector<double> Value::numbers(std::size_t count, const Range& range, const char* what) const {
  if (json_->is_number()) return std::vector<double>(count, number(range));
  if (!json_->is_array()) refuse(std::string(range.words) + ", or an array of them, one for each " + what);
  if (size() != count)
    throw SceneError(path_ + ": got " + std::to_string(size()) + " numbers; must be one number, or " +
                     std::to_string(count) + ", one for each " + what);
  std::vector<double> all;
  for (std::size_t i = 0; i < count; ++i) all.push_back(at(i).number(range));
  return all;
}

std::vector<double> Value::vector(std::size_t count, const Range& range) const {
  if (!json_->is_array() || json_->size() != count)
    refuse("an array of " + std::to_string(count) + " numbers");
  return numbers(count, range, "component");
}

}  // namespace jetlag
