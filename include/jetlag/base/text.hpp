// SPDX-License-Identifier: MIT
#pragma once
// Numbers as text: with all their digits for files, with few for people.

#include <algorithm>
#include <array>
#include <charconv>
#include <concepts>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>

namespace jetlag {

/// The shortest decimal that reads back as the same number.
std::string number(double value);

/// The same in a field of a table, which stays empty where the number is not finite.
std::string field(double value);

/// A text on one line: control characters and bytes that are no UTF-8 become \n, \t, \x1b, ...
std::string on_one_line(std::string_view text);

/// A name, such as that of a file, as it is printed: itself, or where it would break the line in double quotes, with
/// the above and with \" and \\.
std::string shown_name(const std::string& name);

/// A number in a message: up to 10 digits, and "0" also for -0. Of a type that cannot be written the nearest double.
template <class T>
std::string shown(const T& x) {
  constexpr int digits = 10;
  if constexpr (std::floating_point<T>) {
    std::array<char, 64> text;
    const int most = std::min(digits, std::numeric_limits<T>::digits10);
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), x == 0 ? T(0) : x,
                                       std::chars_format::general, most)
                             .ptr};
  } else if constexpr (requires(std::ostream& out) { out << x; }) {
    std::ostringstream text;
    text.precision(digits);
    text << x;
    return text.str();
  } else if constexpr (requires { static_cast<double>(x); }) {
    return shown(static_cast<double>(x));
  } else {
    return "(a number that cannot be shown)";
  }
}

}  // namespace jetlag
