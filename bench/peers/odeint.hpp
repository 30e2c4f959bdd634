// SPDX-License-Identifier: MIT
#pragma once
// Methods of Boost.Odeint with jetlag's forces.

#include "peers.hpp"

namespace jetlag::bench {

/// Empty where it was built without Boost.
std::vector<Method> odeint_methods();

}  // namespace jetlag::bench
