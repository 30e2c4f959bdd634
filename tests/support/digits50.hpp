// SPDX-License-Identifier: MIT
#pragma once
// Numbers of 50 decimal digits, and of 100 for the truth about these. Expression templates are off: operators return
// numbers.

#include <boost/math/special_functions/erf.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace jetlag::testing {

template <unsigned digits>
using Digits = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<digits>,
                                             boost::multiprecision::et_off>;
using Digits50 = Digits<50>;
using Digits100 = Digits<100>;

}  // namespace jetlag::testing
