// SPDX-License-Identifier: MIT
#pragma once
// The commands of the program. To add one, write its file and add its line here and in main.cpp.

#include "command_line/command.hpp"

namespace jetlag {

Command run_command();
Command ensemble_command();
Command scenes_command();
Command show_command();
Command check_command();
Command methods_command();
Command stability_command();

/// `study` for the list of commands only: studies are a program of their own, jetlag-study, beside this one.
Command study_command();
/// Becomes that program. arguments: those after `study`, ends with a null pointer. Returns an exit code where there is
/// no such program.
int become_study(char** arguments);

}  // namespace jetlag
