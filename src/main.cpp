// SPDX-License-Identifier: MIT
// The program: jetlag run | ensemble | scenes | show | check | methods | study | stability.
//
// Exit codes: 0 success; 1 a file or folder cannot be written; 2 bad input, nothing is written; 3 the run did not reach its end.

#include <string_view>

#include "program/commands.hpp"

int main(int argc, char** argv) {
  using namespace jetlag;
  if (argc > 1 && argv[1] == std::string_view("study")) return become_study(argv + 2);
  return run({"",
              "jetlag: mechanical scenes in time, by Taylor series stopped at a random order",
              {run_command(), scenes_command(), show_command(), check_command(), ensemble_command(),
               methods_command(), study_command(), stability_command()}},
             argc, argv);
}
