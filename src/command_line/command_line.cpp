// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "command_line/command.hpp"
#include "jetlag/base/text.hpp"
#include "jetlag/scenes/error.hpp"
#include "jetlag/version.hpp"

namespace jetlag {

namespace {

std::string has_a_name(const std::string& folder) {
  return folder.empty() ? std::string("got \"\"; must be the name of a folder") : std::string();
}

void check(CLI::Option&, const Anything&, bool) {}
void check(CLI::Option& option, const Positive&, bool) { option.check(CLI::PositiveNumber); }
void check(CLI::Option& option, const OneOf& names, bool) { option.check(CLI::IsMember(names)); }
void check(CLI::Option& option, const Between& range, bool whole) {
  if (whole)
    option.check(CLI::Range(static_cast<int>(range.low), static_cast<int>(range.high)));
  else
    option.check(CLI::Range(range.low, range.high));
}

CLI::Option* add_option(CLI::App& command, const Option& option, bool& value) {
  return command.add_flag(option.name, value, option.what);
}

template <class T>
CLI::Option* add_option(CLI::App& command, const Option& option, T& value) {
  constexpr bool is_text = std::is_same_v<T, std::string> || std::is_same_v<T, std::filesystem::path>;
  constexpr bool is_list = !is_text && !std::is_arithmetic_v<T>;
  constexpr bool whole = std::is_same_v<T, int> || std::is_same_v<T, std::vector<int>>;
  CLI::Option* added = command.add_option(option.name, value, option.what);
  if constexpr (std::is_same_v<T, std::filesystem::path>) added->check(has_a_name);
  std::visit([&](const auto& allowed) { check(*added, allowed, whole); }, option.allowed);
  if constexpr (is_list && !std::is_same_v<T, std::vector<std::string>>) added->delimiter(',');
  if (option.once_each) added->allow_extra_args(false);
  if constexpr (std::is_arithmetic_v<T>)
    added->capture_default_str();
  else if (!value.empty())
    added->capture_default_str();
  return added;
}

void add(CLI::App& app, const Command& command, const Command*& chosen) {
  CLI::App* subcommand = app.add_subcommand(command.name, command.what);
  std::vector<std::pair<CLI::Option*, bool*>> watched;
  for (const Option& option : command.options) {
    CLI::Option* added =
        std::visit([&](auto* value) { return add_option(*subcommand, option, *value); }, option.target);
    added->required(option.required);
    if (option.given != nullptr) watched.emplace_back(added, option.given);
  }
  subcommand->callback([&command, &chosen, watched] {
    for (const auto& [option, given] : watched) *given = option->count() > 0;
    chosen = &command;
  });
}

/// Says why, on one line, whatever is in the names in it.
int ended(const std::string& why, int exit_code) {
  std::fprintf(stderr, "jetlag: %s\n", on_one_line(why).c_str());
  return exit_code;
}

}  // namespace

int run(const CommandLine& line, int argc, char** argv) {
  CLI::App app(line.what, line.name);
  app.set_version_flag("--version", std::string("jetlag ") + version);
  app.require_subcommand(1);
  const Command* chosen = nullptr;
  for (const Command& command : line.commands) add(app, command, chosen);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : bad_input;
  }
  try {
    const int code = chosen->run();
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
      throw std::runtime_error("cannot write to standard output");
    return code;
  } catch (const SceneError& error) {
    return ended(error.what(), bad_input);
  } catch (const std::invalid_argument& error) {
    return ended(error.what(), bad_input);
  } catch (const std::filesystem::filesystem_error& error) {
    return ended("cannot write " + shown_name(error.path1().string()) + ": " + error.code().message() +
                     "; give another folder, or make room or rights there",
                 cannot_write);
  } catch (const std::bad_alloc&) {
    return ended(
        "the memory that this process may have is not enough; take fewer particles or frames, or allow it "
        "more",
        bad_input);
  } catch (const std::exception& error) {
    return ended(error.what(), cannot_write);
  }
}

}  // namespace jetlag
