// SPDX-License-Identifier: MIT
// Prints the table of accuracy, in markdown. See measure.hpp for the units.

#include <cstdio>

#include "accuracy/table.hpp"

int main() {
  std::fputs(jetlag::accuracy::table(500).c_str(), stdout);
  return 0;
}
