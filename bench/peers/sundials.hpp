// SPDX-License-Identifier: MIT
#pragma once
// Methods of SUNDIALS (ARKODE, CVODE) with jetlag's forces.

#include "peers.hpp"

namespace jetlag::bench {

/// Empty where it was built without SUNDIALS.
std::vector<Method> sundials_methods();

}  // namespace jetlag::bench
