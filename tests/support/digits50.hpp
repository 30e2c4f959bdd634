// SPDX-License-Identifier: MIT
#pragma once
// Numbers of 50 decimal digits. Expression templates are off: operators return numbers.

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace jetlag::testing {

using Digits50 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

}  // namespace jetlag::testing
