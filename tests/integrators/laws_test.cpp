// SPDX-License-Identifier: MIT
// Every integrator obeys the laws of the family.

#include "integrators/laws.hpp"

namespace jetlag::testing {

const auto name_of = [](const auto& info) { return info.param.name; };

INSTANTIATE_TEST_SUITE_P(, IntegratorLaws, ::testing::ValuesIn(methods), name_of);
INSTANTIATE_TEST_SUITE_P(, SymmetricIntegratorLaws,
                         ::testing::ValuesIn(methods_that_declare(&Method::symmetric)), name_of);
INSTANTIATE_TEST_SUITE_P(, BoundedEnergyIntegratorLaws,
                         ::testing::ValuesIn(methods_that_declare(&Method::energy_bounded)), name_of);

}  // namespace jetlag::testing
