// SPDX-License-Identifier: MIT
#pragma once
// Reading JSON with the path of every value at hand, so that an error names the key, the value and what is allowed.

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <memory>
#include <nlohmann/json_fwd.hpp>  // the whole of it takes seconds to compile: only reader.cpp and reader_document.cpp need it, in one batch
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace jetlag {

using Json = nlohmann::ordered_json;

/// Parses JSON text. Throws SceneError naming the path where it breaks: not well-formed, a number beyond double, a key
/// given twice, nesting deeper than 32.
Json parsed(std::string_view text, const std::string& source);
/// Text on one line.
std::string dumped(const Json& json);

/// A value as errors show it: not all of a long one.
std::string shortened(const std::string& value);

/// A range of numbers, with the words for it.
struct Range {
  double low, high;
  bool low_included, high_included;
  const char* words;
  bool contains(double x) const {
    return (low_included ? x >= low : x > low) && (high_included ? x <= high : x < high);
  }
};
inline constexpr double infinite = std::numeric_limits<double>::infinity();
inline constexpr Range any_number{-infinite, infinite, false, false, "a finite number"};
inline constexpr Range positive{0, infinite, false, false, "a number > 0"};
inline constexpr Range fraction{0, 1, false, true, "a number > 0 and <= 1"};
inline constexpr Range non_negative{0, infinite, true, false, "a number >= 0"};

/// What stands in for a value that is missing; an object or another array as the text of a file has it.
struct JsonText {
  const char* text;
};
using Fallback = std::variant<bool, std::int64_t, double, std::string, std::vector<double>, JsonText>;

/// A value and its path.
class Value {
 public:
  Value(Json& json, std::string path) : json_(&json), path_(std::move(path)) {}

  const std::string& path() const { return path_; }

  /// Throws SceneError: "path: got VALUE; must be ALLOWED".
  [[noreturn]] void refuse(const std::string& allowed) const;

  bool is_string() const;
  bool is_array() const;
  bool is_object() const;
  bool is_number() const;

  /// An object with no other keys than these. To be called before its values are taken.
  const Value& only(std::initializer_list<std::string_view> keys) const {
    return only(std::vector<std::string_view>(keys));
  }
  const Value& only(const std::vector<std::string_view>& keys) const;
  bool has(const std::string& key) const;
  Value at(const std::string& key) const;  // refuses when missing
  std::optional<Value> find(const std::string& key) const;

  /// The value of a key, put in when missing: a scene that has been read is complete.
  Value at(const std::string& key, const Fallback& fallback) const;

  /// Puts a text in its place.
  void replace(const std::string& text) const;

  std::size_t size() const;  // of an array; refuses anything else
  Value at(std::size_t i) const;

  double number(const Range& range = any_number) const;
  /// Whole numbers may be written with a point or an exponent, as 2.0 and 1e3.
  std::int64_t integer(std::int64_t low, std::int64_t high) const;
  std::uint64_t seed() const;
  bool boolean() const;
  std::string text() const;
  std::string one_of(const std::vector<std::string>& names) const;

  /// `count` numbers: an array of that length, or one number for all. what: "particle", "spring", ...
  std::vector<double> numbers(std::size_t count, const Range& range, const char* what) const;

  /// A vector of exactly `count` numbers.
  std::vector<double> vector(std::size_t count, const Range& range = any_number) const;

 private:
  std::optional<std::int64_t> written_with_a_point() const;

  Json* json_;
  std::string path_;
};

/// A scene file, or a part of one, as it is read: reading puts in what is missing.
class Document {
 public:
  /// Throws SceneError, as `parsed`.
  Document(std::string_view text, const std::string& source);
  ~Document();
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  /// "key.path=value", where the path is such as forces[1].stiffness[3] and a value that is not JSON is a text.
  /// Throws SceneError.
  void set(const std::string& setting);

  /// All of it; path: what errors call it.
  Value root(const std::string& path = "");
  /// Indented by two. Throws SceneError where a text is not UTF-8.
  std::string text() const;

 private:
  std::unique_ptr<Json> json_;
};

}  // namespace jetlag
