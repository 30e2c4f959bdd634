// SPDX-License-Identifier: MIT
#pragma once
// Commands and their options as data. Only command_line.cpp knows the library that parses them: its headers take seconds
// to compile.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace jetlag {

/// What a value must be; of a list, each of its values.
struct Anything {};
struct Positive {};
struct Between {
  double low, high;  // both allowed; of whole numbers, whole
};
using OneOf = std::vector<std::string>;

/// Where a value goes: a flag, a number, a text, a folder (which must have a name), or a list, whose numbers may be
/// separated by commas. What it points to is the default, which --help shows.
using Target = std::variant<bool*, int*, std::uint64_t*, double*, std::string*, std::filesystem::path*,
                            std::vector<int>*, std::vector<double>*, std::vector<std::string>*>;

struct Option {
  std::string name;  // "--until"; without dashes: an argument that is known by its place
  Target target;
  std::string what;
  std::variant<Anything, Positive, Between, OneOf> allowed = Anything{};
  bool required = false;
  bool once_each = false;  // of a list: each value has the option's name before it
  bool* given = nullptr;   // where it is put whether the option was there
};

struct Command {
  std::string name, what;
  std::vector<Option> options;
  std::function<int()> run;  // returns an exit code
};

/// A command whose options fill in Arguments.
template <class Arguments>
Command command(std::string name, std::string what, int (*run)(const Arguments&),
                std::vector<Option> (*options)(Arguments&), Arguments defaults = {}) {
  auto arguments = std::make_shared<Arguments>(std::move(defaults));
  return {std::move(name), std::move(what), options(*arguments),
          [arguments, run] { return run(*arguments); }};
}

constexpr int cannot_write = 1, bad_input = 2, not_finished = 3;  // exit codes

struct CommandLine {
  std::string name;  // as --help says it; empty: as it was called
  std::string what;
  std::vector<Command> commands;
};

/// Parses the arguments and runs the command that they name. Returns its exit code; what goes wrong is said on stderr.
int run(const CommandLine& line, int argc, char** argv);

}  // namespace jetlag
