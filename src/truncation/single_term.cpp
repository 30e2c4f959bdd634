// SPDX-License-Identifier: MIT
#include "jetlag/truncation/single_term.hpp"

namespace jetlag {

TruncationLaw single_term(const TruncationLaw& law) {
  std::vector<double> tail;
  for (int n = 0; n <= law.max_degree(); ++n) tail.push_back(law.at_least(n));
  return {"single_term", std::move(tail), Weighting::single_term};
}

}  // namespace jetlag
