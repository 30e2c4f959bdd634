// SPDX-License-Identifier: MIT
#include "jetlag/base/work.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>

namespace jetlag {
namespace {

using Numbers = std::array<std::uint64_t, sizeof(Work) / sizeof(std::uint64_t)>;

TEST(Work,
     IsAddedNumberByNumber) {  // whatever numbers there are: a field that is left out would keep its value
  Numbers a{}, b{}, sum{};
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i] = i + 1;
    b[i] = 100 * (i + 1);
    sum[i] = 101 * (i + 1);
  }
  Work work = std::bit_cast<Work>(a);
  work += std::bit_cast<Work>(b);
  EXPECT_EQ(std::bit_cast<Numbers>(work), sum);
}

}  // namespace
}  // namespace jetlag
