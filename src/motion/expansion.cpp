// SPDX-License-Identifier: MIT
#include "jetlag/motion/expansion.hpp"

namespace jetlag {
template class Expansion<double>;
}  // namespace jetlag
