// SPDX-License-Identifier: MIT
#pragma once
// The engine for the numbers that tests run it in, beside double: compiled once, in engine_of_numbers.cpp. A file that
// does without this header compiles what it needs itself, at the cost of some seconds.

#include <span>
#include <vector>

#include "jetlag/integrators/first_order_taylor.hpp"
#include "jetlag/integrators/particle_taylor.hpp"
#include "jetlag/motion/expansion.hpp"
#include "jetlag/motion/first_order.hpp"
#include "support/digits50.hpp"
#include "support/running_error.hpp"

// declared: extern, or nothing for the definitions.

#define JETLAG_TESTS_ENGINE_OF(declared, ...)                                                             \
  declared template const KernelTable<__VA_ARGS__>& scalar_kernels();                                     \
  declared template class Blocks<__VA_ARGS__>;                                                            \
  declared template class FirstOrderExpansion<__VA_ARGS__>;                                               \
  declared template class System<__VA_ARGS__>;                                                            \
  declared template class Model<__VA_ARGS__>;                                                             \
  declared template class ElementBlocks<__VA_ARGS__>;                                                     \
  declared template class Expansion<__VA_ARGS__>;                                                         \
  declared template class OneClockTaylor<ParticleTaylor<__VA_ARGS__>, Expansion<__VA_ARGS__>,             \
                                         State<__VA_ARGS__>, ParticleTaylorOptions<__VA_ARGS__>>;         \
  declared template class ParticleTaylor<__VA_ARGS__>;                                                    \
  declared template class OneClockTaylor<FirstOrderTaylor<__VA_ARGS__>, FirstOrderExpansion<__VA_ARGS__>, \
                                         FirstOrderState<__VA_ARGS__>, FirstOrderOptions<__VA_ARGS__>>;   \
  declared template class FirstOrderTaylor<__VA_ARGS__>;

// Numbers with errors have no absolute value and are no double: only what needs neither.
#define JETLAG_TESTS_SERIES_OF(declared, ...)                                                          \
  declared template const KernelTable<__VA_ARGS__>& scalar_kernels();                                  \
  declared template class Blocks<__VA_ARGS__>;                                                         \
  declared template class System<__VA_ARGS__>;                                                         \
  declared template class Model<__VA_ARGS__>;                                                          \
  declared template ElementBlocks<__VA_ARGS__>::ElementBlocks(                                         \
      int, const std::vector<__VA_ARGS__>&, const Elements<__VA_ARGS__>&, const Tape&,                 \
      const KernelTable<__VA_ARGS__>&, std::span<const int>);                                          \
  declared template Expansion<__VA_ARGS__>::Expansion(const Model<__VA_ARGS__>&, int,                  \
                                                      const KernelTable<__VA_ARGS__>&, Workers);       \
  declared template void Expansion<__VA_ARGS__>::start(const State<__VA_ARGS__>&, const __VA_ARGS__&); \
  declared template void Expansion<__VA_ARGS__>::grow_to(int);

namespace jetlag {

JETLAG_TESTS_ENGINE_OF(extern, long double)
JETLAG_TESTS_ENGINE_OF(extern, testing::Digits50)
JETLAG_TESTS_SERIES_OF(extern, testing::RunningError<double>)

}  // namespace jetlag
