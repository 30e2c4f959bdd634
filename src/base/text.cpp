// SPDX-License-Identifier: MIT
#include "jetlag/base/text.hpp"

#include <cmath>

namespace jetlag {

namespace {

/// The length of the character that a text begins with; 0 where that is no UTF-8, or a control character.
/// Source: RFC 3629, with its table of well-formed sequences.
std::size_t printable(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const auto follows = [&](std::size_t i, unsigned low = 0x80, unsigned high = 0xbf) {
    return low <= byte(i) && byte(i) <= high;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
  if (first == 0xc2) return follows(1, 0xa0) ? 2 : 0;  // below are control characters
  if (0xc3 <= first && first <= 0xdf) return follows(1) ? 2 : 0;
  if (0xe0 <= first && first <= 0xef)
    return follows(1, first == 0xe0 ? 0xa0 : 0x80, first == 0xed ? 0x9f : 0xbf) && follows(2) ? 3 : 0;
  if (0xf0 <= first && first <= 0xf4)
    return follows(1, first == 0xf0 ? 0x90 : 0x80, first == 0xf4 ? 0x8f : 0xbf) && follows(2) && follows(3)
               ? 4
               : 0;
  return 0;
}

std::string escaped(char c) {
  constexpr const char* digits = "0123456789abcdef";
  if (c == '\n') return "\\n";
  if (c == '\t') return "\\t";
  if (c == '\r') return "\\r";
  const auto code = static_cast<unsigned char>(c);
  return {'\\', 'x', digits[code / 16], digits[code % 16]};
}

}  // namespace

std::string number(double value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string field(double value) { return std::isfinite(value) ? number(value) : ""; }

std::string on_one_line(std::string_view text) {
  std::string line;
  while (!text.empty()) {
    const std::size_t length = printable(text);
    if (length > 0)
      line += text.substr(0, length);
    else
      line += escaped(text[0]);
    text.remove_prefix(std::max<std::size_t>(1, length));
  }
  return line;
}

std::string shown_name(const std::string& name) {
  if (on_one_line(name) == name) return name;
  std::string marked;
  for (const char c : name) {
    if (c == '"' || c == '\\') marked += '\\';
    marked += c;
  }
  return '"' + on_one_line(marked) + '"';
}

}  // namespace jetlag
