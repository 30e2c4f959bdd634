// SPDX-License-Identifier: MIT
#pragma once
// A text file, word by word.

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>

namespace jetlag {

/// Words of a file, one after another, with their line numbers; '#' starts a comment, what is in double quotes is one word
/// with them. Whatever the file holds, no more than a line of it is kept.
/// What is wrong is a SceneError with file and line.
class Words {
 public:
  explicit Words(const std::filesystem::path& file);

  /// The next word; false at the end.
  bool next(std::string& word);

  /// The next word of the line that the last one stood in; false at its end, where a backslash goes on in the next line.
  bool next_in_line(std::string& word);
  /// What is left of that line.
  void pass_over_line() { at_ = line_.size(); }

  /// The next word as a number; what: in messages.
  double real(const char* what);
  long whole(const char* what, long low, long high);

  /// The number of the line of the last word.
  long line() const { return number_; }
  const std::string& name() const { return name_; }

  [[noreturn]] void refuse(const std::string& why) const;

 private:
  bool next_line();
  bool word_at(std::string& word);
  std::string required(const char* what);

  std::string name_;
  std::ifstream in_;
  std::string line_;
  std::size_t at_ = 0;  // in the line
  long number_ = 0;
};

}  // namespace jetlag
