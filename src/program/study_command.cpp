// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "program/commands.hpp"

namespace jetlag {

Command study_command() {
  return {"study", "make a table from many runs; `study --help` lists which", {}, [] {
            char* none[] = {nullptr};
            return become_study(none);
          }};
}

int become_study(char** arguments) {
  std::error_code error;  // where there is no /proc it is sought in PATH
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::string program = (self.parent_path() / "jetlag-study").string();
  std::vector<char*> all = {const_cast<char*>(program.c_str())};
  for (char** argument = arguments; *argument != nullptr; ++argument) all.push_back(*argument);
  all.push_back(nullptr);
  execvp(program.c_str(),
         all.data());  // returns only when it fails; the process is the same one: so are its signals
  const int why = errno;
  std::fprintf(
      stderr,
      "jetlag: study: cannot start %s: %s; build it with `./run study NAME`, or the target jetlag-study of "
      "CMake\n",
      program.c_str(), std::strerror(why));
  return cannot_write;
}

}  // namespace jetlag
