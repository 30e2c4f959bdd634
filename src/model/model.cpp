// SPDX-License-Identifier: MIT
#include "jetlag/model/model.hpp"

namespace jetlag {
template class System<double>;
template class ElementBlocks<double>;
template class Model<double>;
}  // namespace jetlag
