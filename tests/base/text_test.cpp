// SPDX-License-Identifier: MIT
#include "jetlag/base/text.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>

namespace jetlag::testing {
namespace {

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

double read(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

TEST(Number, ReadsBackToTheSameBits) {
  std::mt19937_64 bits(1);
  for (int i = 0; i < 100000; ++i) {
    const auto value = std::bit_cast<double>(bits());
    ASSERT_TRUE(!std::isfinite(value) || same_bits(read(number(value)), value)) << number(value);
  }
}

TEST(Number, ReadsBackSubnormals) {
  std::mt19937_64 bits(2);
  for (int i = 0; i < 100000; ++i) {
    const auto value = std::bit_cast<double>(bits() >> 12);
    ASSERT_TRUE(same_bits(read(number(value)), value)) << number(value);
  }
  for (const double value : {0.0, -0.0, std::numeric_limits<double>::denorm_min()})
    EXPECT_TRUE(same_bits(read(number(value)), value)) << number(value);
}

TEST(Number, IsShortest) {
  EXPECT_EQ(number(0.1), "0.1");
  EXPECT_EQ(number(5e-324), "5e-324");
  EXPECT_EQ(number(9007199254740993.0), "9007199254740992");
}

TEST(Shown, HasTenDigitsAndNoMoreThanItsTypeKnows) {
  EXPECT_EQ(shown(1.0 / 3), "0.3333333333");
  EXPECT_EQ(shown(0.1f), "0.1");
  EXPECT_EQ(shown(1000.555), "1000.555");
  EXPECT_EQ(shown(1e-17), "1e-17");
  EXPECT_EQ(shown(-0.0), "0");
  EXPECT_EQ(shown(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(shown(boost::multiprecision::cpp_bin_float_50(1) / 3), "0.3333333333");
  EXPECT_EQ(shown(7), "7");
}

TEST(Shown, TakesTypesThatCanOnlyBeTurnedIntoADouble) {
  struct Half {
    explicit operator double() const { return 0.5; }
  };
  struct Nothing {};
  EXPECT_EQ(shown(Half{}), "0.5");
  EXPECT_EQ(shown(Nothing{}), "(a number that cannot be shown)");
}

TEST(OnOneLine, KeepsEveryCharacterThatIsShownAsItIs) {
  for (const std::string text :
       {"", "out/body", "a b\\c\"d", "M\u00fcnchen", "\u03b5 \u2260 0", "\U0001f407", "\u00a0"})
    EXPECT_EQ(on_one_line(text), text);
}

TEST(OnOneLine, SpellsOutWhatBreaksALine) {
  EXPECT_EQ(on_one_line("a\nb\tc\rd"), "a\\nb\\tc\\rd");
  EXPECT_EQ(on_one_line("\x1b[2J\x7f"), "\\x1b[2J\\x7f");
  EXPECT_EQ(on_one_line(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(on_one_line("\u0085"), "\\xc2\\x85");  // a line end too
}

TEST(OnOneLine,
     SpellsOutWhatIsNoUtf8) {  // RFC 3629: overlong, cut off, half of a pair, beyond the last plane
  EXPECT_EQ(on_one_line("\xff"), "\\xff");
  EXPECT_EQ(on_one_line("\xc0\xaf"), "\\xc0\\xaf");
  EXPECT_EQ(on_one_line("\xe0\x80\x80"), "\\xe0\\x80\\x80");
  EXPECT_EQ(on_one_line("\xe2\x82"), "\\xe2\\x82");
  EXPECT_EQ(on_one_line("\xed\xa0\x80"), "\\xed\\xa0\\x80");
  EXPECT_EQ(on_one_line("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");
}

TEST(ShownName, IsQuotedOnlyWhereItWouldBreakTheLine) {
  EXPECT_EQ(shown_name("out/a \"b\" \\"), "out/a \"b\" \\");
  EXPECT_EQ(shown_name("a\nb"), R"("a\nb")");
  EXPECT_EQ(shown_name("\"a\\\n"), R"("\"a\\\n")");
}

TEST(Field, IsEmptyWhereThereIsNoNumber) {
  EXPECT_EQ(field(0.5), "0.5");
  EXPECT_EQ(field(std::nan("")), "");
  EXPECT_EQ(field(-std::numeric_limits<double>::infinity()), "");
}

}  // namespace
}  // namespace jetlag::testing
