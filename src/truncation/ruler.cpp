// SPDX-License-Identifier: MIT
#include <cmath>
#include <stdexcept>

#include "jetlag/base/text.hpp"
#include "jetlag/truncation/draws.hpp"
#include "truncation/philox.hpp"

namespace jetlag {

Ruler::Ruler(const TruncationLaw& law, bool scrambled) : min_(law.min_degree()), scrambled_(scrambled) {
  for (int n = min_ + 1; n <= law.max_degree(); ++n) {
    const double base = law.at_least(n - 1) / law.at_least(n), whole = std::round(base);
    if (std::abs(base - whole) > 1e-12 * base || !(whole < 0x1p53))  // a few roundings of the tail
      throw std::invalid_argument(
          "ruler: the probability to go on to term " + std::to_string(n) + " is " +
          shown(law.at_least(n) / law.at_least(n - 1)) + ", one in " + std::to_string(base) +
          "; must be one in 2, 3, 4 .. (a probability p to stop of 1/2, 2/3, 3/4 ..)");
    bases_.push_back(static_cast<std::uint64_t>(whole));
  }
}

/// update - offset ends in as many zeros as there are last digits in which the two agree. The digits of the offset are
/// random, each for itself, so that no number is too large; `scrambled` has other ones in each block.
int Ruler::degree(std::uint64_t seed, std::uint32_t particle, std::uint64_t update) const {
  int k = min_;
  for (std::uint32_t i = 0; i < bases_.size(); ++i, ++k) {
    const std::uint64_t b = bases_[i], digit = update % b;
    update /= b;  // the number of the block of b, or of b blocks
    if (digit != below(b, random_bits(seed, particle, scrambled_ ? update : 0, Stream::digit, i)[0])) break;
  }
  return k;
}

}  // namespace jetlag
