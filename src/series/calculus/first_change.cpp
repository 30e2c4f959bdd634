// SPDX-License-Identifier: MIT
#include "jetlag/series/calculus/first_change.hpp"

namespace jetlag {

template std::optional<double> first_change(std::span<const double>, int, const double&);

}  // namespace jetlag
