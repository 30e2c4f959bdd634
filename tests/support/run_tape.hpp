// SPDX-License-Identifier: MIT
#pragma once
// A tape run as a scene runs it: over blocks of elements, order by order.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "jetlag/series/jet.hpp"
#include "jetlag/tape/program.hpp"

namespace jetlag::testing {

inline bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// The result of each element. Its inputs are the components 0 .. n - 1 of a position.
template <int degree, std::size_t n>
std::vector<Jet<double, degree>> run_tape(const Tape& tape,
                                          const std::vector<std::array<Jet<double, degree>, n>>& operands,
                                          const std::vector<double>& parameters,
                                          const KernelTable<double>& table) {
  const Program program(tape);
  Blocks<double> blocks(program, operands.size(), parameters, table);
  blocks.reserve(degree + 1);
  std::vector<Jet<double, degree>> results(operands.size());
  for (int k = 0; k <= degree; ++k)
    for (std::size_t b = 0; b < blocks.blocks(); ++b) {
      for (const auto& [place, input] : program.inputs)
        for (int lane = 0; lane < blocks.lanes(); ++lane)
          blocks.at(b, place, k)[lane] = operands[blocks.element(b, lane)][input.component][k];
      blocks.run(b, k);
      for (int lane = 0; lane < blocks.lanes(); ++lane)
        results[blocks.element(b, lane)][k] = blocks.at(b, program.outputs[0], k)[lane];
    }
  return results;
}

}  // namespace jetlag::testing
