// SPDX-License-Identifier: MIT
#include "scenes/meshes/words.hpp"

#include <algorithm>
#include <system_error>

#include "jetlag/base/text.hpp"
#include "jetlag/scenes/error.hpp"
#include "scenes/meshes/numbers.hpp"

namespace jetlag {

namespace {

constexpr std::size_t longest_line = 100'000;
constexpr const char* space = " \t\r\v\f";

}  // namespace

Words::Words(const std::filesystem::path& file) : name_(shown_name(file.string())), in_(file) {
  std::error_code why;
  if (!std::filesystem::is_regular_file(file, why) || !in_)
    throw SceneError("mesh: got \"" + name_ + "\"; must be a file that can be read");
}

/// Reads no further than a line may be long.
bool Words::next_line() {
  using Character = std::ifstream::traits_type;
  line_.clear();
  at_ = 0;
  try {
    auto* const file = in_.rdbuf();
    auto c = file->sbumpc();
    if (Character::eq_int_type(c, Character::eof())) return false;
    ++number_;
    for (; !Character::eq_int_type(c, Character::eof()) && c != '\n'; c = file->sbumpc()) {
      line_ += Character::to_char_type(c);
      if (line_.size() > longest_line)
        refuse("a line longer than " + std::to_string(longest_line) + " characters");
    }
    if (number_ == 1 && line_.starts_with("\xEF\xBB\xBF")) line_.erase(0, 3);  // a byte-order mark
  } catch (const std::ios_base::failure&) {  // of the system: this is a file, but gives nothing to read
    refuse("it cannot be read");
  }
  return true;
}

bool Words::next(std::string& word) {
  while (!word_at(word))
    if (!next_line()) return false;
  return true;
}

bool Words::next_in_line(std::string& word) {
  const bool goes_on = line_.find('#') == std::string::npos && !line_.empty() &&
                       line_[std::min(line_.find_last_not_of(space), line_.size() - 1)] == '\\';
  if (word_at(word)) {
    const bool is_last = goes_on && line_.find_first_not_of(space, at_) == std::string::npos;
    if (is_last) word.pop_back();
    if (!word.empty()) return true;
  }
  return goes_on && next_line() && next_in_line(word);
}

bool Words::word_at(std::string& word) {
  at_ = std::min(line_.find_first_not_of(space, at_), line_.size());
  if (at_ == line_.size() || line_[at_] == '#') return false;
  auto end = line_[at_] == '"' ? line_.find('"', at_ + 1) : line_.find_first_of(" \t\r\v\f#\"", at_);
  if (end != std::string::npos && line_[at_] == '"') ++end;
  if (end == std::string::npos) end = line_.size();
  word.assign(line_, at_, end - at_);
  at_ = end;
  return true;
}

double Words::real(const char* what) {
  const std::string word = required(what);
  if (const auto x = number_of(word)) return *x;
  refuse("got '" + word.substr(0, 40) + "' for " + what + "; must be a finite number");
}

long Words::whole(const char* what, long low, long high) {
  const std::string word = required(what);
  if (const auto x = whole_number_of(word); x && low <= *x && *x <= high) return *x;
  refuse("got '" + word.substr(0, 40) + "' for " + what + "; must be a whole number from " +
         std::to_string(low) + " to " + std::to_string(high));
}

void Words::refuse(const std::string& why) const {
  throw SceneError("mesh: " + name_ + ", line " + std::to_string(number_) + ": " + why);
}

std::string Words::required(const char* what) {
  std::string word;
  if (!next(word)) refuse(std::string("the file ends where ") + what + " is expected");
  return word;
}

}  // namespace jetlag
