// SPDX-License-Identifier: MIT
#include <cstdio>
#include <filesystem>

#include "jetlag/output/files.hpp"
#include "jetlag/scenes/error.hpp"
#include "program/commands.hpp"
#include "scenes/methods/methods.hpp"

namespace jetlag {

namespace {

struct MethodsArguments {
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

int run(const MethodsArguments& arguments) {
  if (!arguments.folder.empty() && !arguments.name.empty())
    throw SceneError("--out: writes the pages of all methods; leave out the name " + arguments.name);
  if (!arguments.folder.empty())
    write_all(arguments.folder);
  else if (!arguments.name.empty())
    std::printf("%s", markdown(method_page(arguments.name)).c_str());
  else
    list();
  return 0;
}

}  // namespace

Command methods_command() {
  return command<MethodsArguments>(
      "methods", "list the methods, or print the page of one", run,
      [](MethodsArguments& a) -> std::vector<Option> {
        return {{"name", &a.name, "of a method, as in a scene"},
                {"--out", &a.folder, "folder for the pages of all methods and an index.md"}};
      });
}

}  // namespace jetlag
