// SPDX-License-Identifier: MIT
#include "studies/methods_command.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "jetlag/output/files.hpp"
#include "scenes/methods/methods.hpp"

namespace jetlag {

namespace {

struct Arguments {
  std::string name;
  std::filesystem::path folder;
};

void list() {
  for (const MethodPage& page : method_pages())
    std::printf("%-19s %s\n", page.name.c_str(), page.what.c_str());
}

void write_all(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);  // write_file says what is wrong
  for (const MethodPage& page : method_pages())
    write_file(folder / (page.name + ".md"), markdown(page), Until::handed_over);
  const std::filesystem::path index = folder / "index.md";
  write_file(index, markdown_index(method_pages()));
  std::printf("%s and %zu pages\n", index.string().c_str(), method_pages().size());
}

int run(const Arguments& arguments) {
  if (!arguments.folder.empty())
    write_all(arguments.folder);
  else if (!arguments.name.empty())
    std::printf("%s", markdown(method_page(arguments.name)).c_str());
  else
    list();
  return 0;
}

}  // namespace

void add_methods(CLI::App& app, std::optional<Study>& chosen) {
  auto* command = app.add_subcommand("methods", "list the methods, or print the page of one");
  auto arguments = std::make_shared<Arguments>();
  auto* name = command->add_option("name", arguments->name, "of a method, as in a scene");
  command->add_option("--out", arguments->folder, "folder for the pages of all methods and an index.md")
      ->excludes(name);
  command->callback([&chosen, arguments] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace jetlag
