// SPDX-License-Identifier: MIT
#pragma once
// Numbers as programs in Fortran, C and others write them.

#include <optional>
#include <string>

namespace jetlag {

/// The double nearest to a decimal number: "1.5", "+1.5", "1.5D+00", "1.5d0", "1.5Q+00", and "1.5-300", as Fortran leaves
/// out the letter before three digits. What is nearest to 0 is 0. Nothing where it is no number, or beyond double.
std::optional<double> number_of(const std::string& word);

/// A whole number, also as "2.0" or "2.0E+00" up to 2^53. Nothing where it is none.
std::optional<long> whole_number_of(const std::string& word);

}  // namespace jetlag
