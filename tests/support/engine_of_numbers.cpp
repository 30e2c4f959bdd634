// SPDX-License-Identifier: MIT
#include "support/engine_of_numbers.hpp"

namespace jetlag {

JETLAG_TESTS_ENGINE_OF(, long double)
JETLAG_TESTS_ENGINE_OF(, testing::Digits50)
JETLAG_TESTS_SERIES_OF(, testing::RunningError<double>)

}  // namespace jetlag
