// SPDX-License-Identifier: MIT
#include "jetlag/motion/expansion.hpp"

namespace jetlag {
template class System<double>;
template class Expansion<double>;
}  // namespace jetlag
