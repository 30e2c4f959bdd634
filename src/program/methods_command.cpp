// SPDX-License-Identifier: MIT
#include <cstdio>
#include <filesystem>

#include "jetlag/base/text.hpp"
#include "jetlag/output/files.hpp"
#include "jetlag/output/result_folder.hpp"
#include "jetlag/scenes/error.hpp"
#include "program/commands.hpp"
#include "scenes/methods/methods.hpp"
#include "scenes/scene_page.hpp"

namespace jetlag {

namespace {

struct MethodsArguments {
  std::string name;
  std::filesystem::path folder;
};

void list() {
  for (const MethodRecord& record : method_records())
    std::printf("%-19s %s\n", record.name.c_str(), record.what.c_str());
  std::printf("\n%-19s what a scene file may hold, what a run and an ensemble leave\n", "scene");
}

void write_all(const std::filesystem::path& folder) {
  const ResultFolder held(folder);
  for (const MethodRecord& record : method_records())
    write_file(folder / (record.name + ".md"), markdown(record), Until::handed_over);
  write_file(folder / "scene.md", scene_page(), Until::handed_over);
  const std::filesystem::path index = folder / "index.md";
  write_file(index, markdown_index(method_records()));
  std::printf("%s and %zu pages\n", shown_name(index.string()).c_str(), method_records().size());
}

int run(const MethodsArguments& arguments) {
  if (!arguments.folder.empty() && !arguments.name.empty())
    throw SceneError("--out: writes the pages of all methods; leave out the name " + arguments.name);
  if (!arguments.folder.empty())
    write_all(arguments.folder);
  else if (arguments.name == "scene")
    std::printf("%s", scene_page().c_str());
  else if (!arguments.name.empty())
    std::printf("%s", markdown(method_record(arguments.name)).c_str());
  else
    list();
  return 0;
}

}  // namespace

Command methods_command() {
  return command<MethodsArguments>(
      "methods", "list the methods, or print the page of one", run,
      [](MethodsArguments& a) -> std::vector<Option> {
        return {{"name", &a.name, "of a method, as in a scene; or scene: what a scene file may hold"},
                {"--out", &a.folder, "folder for the pages of all methods and an index.md"}};
      });
}

}  // namespace jetlag
