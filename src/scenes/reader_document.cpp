// SPDX-License-Identifier: MIT
// Text into JSON and back, and values put into it from the command line.

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "jetlag/scenes/error.hpp"
#include "scenes/reader.hpp"

namespace jetlag {

namespace {

/// Walks through JSON text and keeps the path of where it is.
class PathFinder : public nlohmann::json_sax<Json> {
 public:
  explicit PathFinder(std::string source) : source_(std::move(source)) {}

  std::string path() const {
    std::string text;
    for (const Level& level : levels_) {
      if (level.is_object)
        text += (text.empty() ? "" : ".") + level.key;
      else
        text += "[" + std::to_string(level.index) + "]";
    }
    return text.empty() ? "(the whole scene)" : text;
  }

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool string(string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }
  bool start_object(std::size_t) override { return open(true); }
  bool start_array(std::size_t) override { return open(false); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    levels_.back().key = name;
    if (!levels_.back().keys.insert(name).second)
      throw SceneError(path() + ": the key is given twice in " + source_ + "; give it once");
    return true;
  }
  bool parse_error(std::size_t, const std::string& token, const nlohmann::detail::exception& error) override {
    std::string why = error.what();
    if (const auto bracket = why.find("] "); bracket != std::string::npos) why = why.substr(bracket + 2);
    if (error.id == 406)
      throw SceneError(path() + ": got " + shortened(token) + " in " + source_ +
                       "; must be a number within the range of double");
    throw SceneError(path() + ": " + source_ + " is not well-formed JSON: " + why +
                     "; numbers are finite, names are in double quotes");
  }

 private:
  struct Level {
    bool is_object;
    std::string key;
    std::size_t index = 0;
    std::set<std::string> keys;
  };
  bool value() {
    if (!levels_.empty() && !levels_.back().is_object) ++levels_.back().index;
    return true;
  }
  bool open(bool is_object) {
    if (levels_.size() >= 32) throw SceneError(path() + ": nested deeper than 32 levels in " + source_);
    levels_.push_back({is_object, "", 0, {}});
    return true;
  }
  bool close() {
    levels_.pop_back();
    return value();
  }

  std::string source_;
  std::vector<Level> levels_;
};

}  // namespace

Json parsed(std::string_view text, const std::string& source) {
  PathFinder finder(source);
  Json::sax_parse(text, &finder);
  return Json::parse(text);
}

std::string dumped(const Json& json) { return json.dump(); }

namespace {

/// A path such as forces[1].stiffness[3] in steps: keys and positions. A step may be empty, as in "control..step".
std::vector<std::string> steps_of(const std::string& path) {
  std::vector<std::string> steps(1);
  for (const char c : path) {
    if (c == '.' || c == '[')
      steps.emplace_back();
    else if (c != ']')
      steps.back() += c;
  }
  return steps;
}

/// "key.path=value" put into the scene.
void apply_setting(Json& json, const std::string& setting) {
  const auto equals = setting.find('=');
  if (equals == std::string::npos || equals == 0)
    throw SceneError("--set " + setting + ": must be key.path=value, such as control.step=0.01");
  const std::string path = setting.substr(0, equals), text = setting.substr(equals + 1);
  const auto steps = steps_of(path);
  if (steps.size() > 16)
    throw SceneError("--set " + setting.substr(0, 60) + ": must be a path of 1 to 16 steps");
  if (std::ranges::count(steps, "") > 0)
    throw SceneError("--set " + setting.substr(0, 60) +
                     ": a part of its path is empty; must be key.path=value, such as control.step=0.01");
  Json* at = &json;
  std::string so_far;
  for (const std::string& step : steps) {
    if (at->is_array()) {
      const bool digits =
          !step.empty() && step.size() < 10 && step.find_first_not_of("0123456789") == std::string::npos;
      const std::size_t i = digits ? std::stoul(step) : at->size();
      if (i >= at->size())
        throw SceneError("--set " + path + ": got [" + step + "]; must be a position below " +
                         std::to_string(at->size()));
      at = &(*at)[i];
    } else if (at->is_object() || at->is_null()) {
      at = &(*at)[step];
    } else {
      throw SceneError("--set " + path + ": " + so_far + " is " + dumped(*at) +
                       ", which has no parts; replace it as a whole");
    }
    so_far += (so_far.empty() ? "" : ".") + step;
  }
  *at = Json::accept(text) ? parsed(text, "--set " + path) : Json(text);
}

}  // namespace

Document::Document(std::string_view text, const std::string& source)
    : json_(std::make_unique<Json>(parsed(text, source))) {}

Document::~Document() = default;

void Document::set(const std::string& setting) { apply_setting(*json_, setting); }

Value Document::root(const std::string& path) { return {*json_, path}; }

std::string Document::text() const {
  try {
    return json_->dump(2);
  } catch (const Json::exception&) {
    throw SceneError("--set: keys and texts must be valid UTF-8");
  }
}

}  // namespace jetlag
