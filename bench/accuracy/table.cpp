// SPDX-License-Identifier: MIT
#include "accuracy/table.hpp"

#if defined(__GLIBC__)
#include <gnu/libc-version.h>
#endif

#include <cstdio>

#include "accuracy/measure.hpp"

namespace jetlag::accuracy {

namespace {

std::string mathematics_library() {
#if defined(__GLIBC__)
  return std::string("glibc ") + gnu_get_libc_version();
#else
  return "another library than glibc";
#endif
}

std::string number(double x, int decimals) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*f", decimals, x);
  return text;
}

std::string domains(const Function& f) {
  std::string text = f.domains[0].text;
  for (std::size_t a = 1; a < f.domains.size(); ++a)
    if (f.domains[a].text != text) text += "; " + f.domains[a].text;
  return text;
}

std::string row(const Function& f, int draws) {
  const Measured m = measure(f, draws);
  const std::string cells[] = {"`" + f.name + "`",
                               domains(f),
                               f.composed ? "composed" : "single",
                               number(m.first.error, 2),
                               number(m.later.error, 1),
                               number(f.limit(), 0),
                               m.later.error > 0 ? m.later.point : "exact",
                               number(m.strict, 1)};
  std::string text = "|";
  for (const auto& cell : cells) text += " " + cell + " |";
  return text + "\n";
}

}  // namespace

std::string table(int draws) {
  std::string text =
      "# Accuracy of all functions\n\n"
      "The largest errors of the coefficients 0 to 20 of jets of doubles, against MPFR with 75 digits. Made "
      "by\n"
      "`./run accuracy` with the functions of " +
      mathematics_library() + "; the same points every time: all corners of a domain and " +
      std::to_string(draws) +
      "\ndraws from it, with six kinds of series at each. Other processors may differ in the last digit "
      "shown, as glibc\n"
      "chooses its code by what they can do.\n\n"
      "- **0**: coefficient 0, in units in the last place of its value; 0.5 is right rounding.\n"
      "- **1 … 20**: in units of 2⁻⁵² max(|v_k|, C_k). C_k is the condition of v_k: what one unit in the "
      "last place of\n"
      "  every given u_j, j ≥ 1, does to it (u_0 counts as exact). Exactly: [measure.hpp](measure.hpp).\n"
      "- **limit**: for both, held by `tests/series/functions/accuracy_test.cpp`: 4 for single rules, 16 for "
      "composed "
      "ones.\n"
      "- **worst at**: the points u_0 of the operands, the coefficient, the kind of series.\n"
      "- **strict**: coefficients 1 … 20 once more, in units of 2⁻⁵² max(|v_k|, S_k) where S_k is the sum of "
      "the absolute\n"
      "  values of all terms without regard to the condition. No limit: it grows with k, by half a unit for "
      "each of the k\n"
      "  times that a rounded v_0 (sqrt) or 1 + u_0 (log1p) enters, and like k² where 1 + u² is nearly the "
      "square of u.\n\n"
      "| function | domain of u_0 | rule | 0 | 1 … 20 | limit | worst at | strict |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const Function& f : functions()) text += row(f, draws);
  return text;
}

}  // namespace jetlag::accuracy
