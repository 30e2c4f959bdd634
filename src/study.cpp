// SPDX-License-Identifier: MIT
// The program of the studies, which `jetlag study` starts. Exit codes as those of main.cpp.

#include "studies/studies.hpp"

int main(int argc, char** argv) {
  return jetlag::run({"jetlag study", "make a table from many runs", jetlag::studies()}, argc, argv);
}
