// SPDX-License-Identifier: MIT
#include "scenes/meshes/numbers.hpp"

#include <charconv>
#include <cmath>
#include <string_view>

namespace jetlag {

namespace {

bool is_digit(char c) { return '0' <= c && c <= '9'; }

/// With 'e' before the exponent and no '+' before the number.
std::string as_in_c(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  std::string text;
  bool has_exponent = false;
  for (const char c : word) {
    const bool after_digits = !text.empty() && (is_digit(text.back()) || text.back() == '.');
    if (after_digits && !has_exponent) {
      const bool is_letter = std::string_view("eEdDqQ").find(c) != std::string_view::npos;
      has_exponent = is_letter || c == '+' || c == '-';
      if (has_exponent) text += 'e';
      if (is_letter) continue;
    }
    text += c;
  }
  return text;
}

/// Whether a number that is out of range is too small: its first digit that is not 0 stands behind the point. Exponents
/// beyond long are as they are signed.
bool is_tiny(std::string_view text) {
  const auto e = text.find('e');
  const std::string_view digits = text.substr(0, e);
  long exponent = 0;
  if (e != std::string_view::npos) {
    std::string_view power = text.substr(e + 1);
    if (power.starts_with('+')) power.remove_prefix(1);
    if (std::from_chars(power.data(), power.data() + power.size(), exponent).ec != std::errc())
      return power.starts_with('-');
  }
  const auto point = static_cast<long>(std::min(digits.find('.'), digits.size())),
             first = static_cast<long>(digits.find_first_of("123456789"));
  return first > point ? exponent < first - point : exponent < first - point + 1;
}

}  // namespace

std::optional<double> number_of(const std::string& word) {
  const std::string text = as_in_c(word);
  double x = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (end != text.data() + text.size()) return {};
  if (error == std::errc::result_out_of_range && is_tiny(text)) return text[0] == '-' ? -0.0 : 0.0;
  if (error != std::errc() || !std::isfinite(x)) return {};
  return x;
}

std::optional<long> whole_number_of(const std::string& word) {
  long i = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), i);
  if (error == std::errc() && end == word.data() + word.size()) return i;
  const auto x = number_of(word);
  if (!x || *x != std::floor(*x) || std::abs(*x) > 0x1p53) return {};
  return static_cast<long>(*x);
}

}  // namespace jetlag
