// SPDX-License-Identifier: MIT
#pragma once
// Numbers of 50 decimal digits, and of 100 for the truth about these. Expression templates are off: operators return
// numbers. The functions of 50 digits are compiled once, in digits50.cpp: each file that calls one would take a second or
// two for them.

#include <boost/math/special_functions/erf.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <ios>
#include <string>

namespace jetlag::testing {

template <unsigned digits>
using Digits = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<digits>,
                                             boost::multiprecision::et_off>;
using Digits50 = Digits<50>;
using Digits100 = Digits<100>;

}  // namespace jetlag::testing

// declared: extern, or nothing for the definitions.
#define JETLAG_TESTS_DIGITS_OF(declared, ...)                                                     \
  declared template __VA_ARGS__& __VA_ARGS__::operator=(const char*);                             \
  declared template std::string __VA_ARGS__::str(std::streamsize, std::ios_base::fmtflags) const; \
  declared template void eval_exp(__VA_ARGS__&, const __VA_ARGS__&);                              \
  declared template void eval_sqrt(__VA_ARGS__&, const __VA_ARGS__&);                             \
  declared template void eval_divide(__VA_ARGS__&, const __VA_ARGS__&, const __VA_ARGS__&);
#define JETLAG_TESTS_FUNCTIONS_OF(declared, ...)                                         \
  declared template void eval_sin(__VA_ARGS__&, const __VA_ARGS__&);                     \
  declared template void eval_cos(__VA_ARGS__&, const __VA_ARGS__&);                     \
  declared template void eval_log(__VA_ARGS__&, const __VA_ARGS__&);                     \
  declared template void eval_pow(__VA_ARGS__&, const __VA_ARGS__&, const __VA_ARGS__&); \
  declared template const __VA_ARGS__& get_constant_pi();                                \
  declared template const __VA_ARGS__& get_constant_ln2();

namespace boost::multiprecision {
namespace backends {
JETLAG_TESTS_DIGITS_OF(extern, cpp_bin_float<50>)
}
namespace default_ops {
JETLAG_TESTS_FUNCTIONS_OF(extern, backends::cpp_bin_float<50>)
}
}  // namespace boost::multiprecision
