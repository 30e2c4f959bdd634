// SPDX-License-Identifier: MIT
#include "support/digits50.hpp"

namespace boost::multiprecision {
namespace backends {
JETLAG_TESTS_DIGITS_OF(, cpp_bin_float<50>)
}
namespace default_ops {
JETLAG_TESTS_FUNCTIONS_OF(, backends::cpp_bin_float<50>)
}
}  // namespace boost::multiprecision
