// SPDX-License-Identifier: MIT
#include "jetlag/integrators/one_clock_taylor.hpp"

#include "jetlag/integrators/first_order_taylor.hpp"
#include "jetlag/integrators/particle_taylor.hpp"

namespace jetlag {
template class OneClockTaylor<FirstOrderTaylor<double>, FirstOrderExpansion<double>, FirstOrderState<double>,
                              FirstOrderOptions<double>>;
template class FirstOrderTaylor<double>;
template class OneClockTaylor<ParticleTaylor<double>, Expansion<double>, State<double>,
                              ParticleTaylorOptions<double>>;
template class ParticleTaylor<double>;
}  // namespace jetlag
