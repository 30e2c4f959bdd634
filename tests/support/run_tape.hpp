// SPDX-License-Identifier: MIT
#pragma once
// A tape run as a scene runs it: over blocks of elements, order by order.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "jetlag/series/jet.hpp"
#include "jetlag/tape/program.hpp"

namespace jetlag::testing {

inline bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// The result of each element, `at_once` orders at a time. Its inputs are components of a position:
/// of each element, a container of their series.
template <class Operands>
std::vector<typename Operands::value_type> run_tape(const Tape& tape, const std::vector<Operands>& operands,
                                                    const std::vector<double>& parameters,
                                                    const KernelTable<double>& table, int at_once = 1) {
  constexpr int degree = Operands::value_type::degree;
  const Program program(tape);
  Blocks<double> blocks(program, operands.size(), parameters, table);
  blocks.reserve(degree + 1);
  std::vector<typename Operands::value_type> results(operands.size());
  for (int k = 0; k <= degree; k += at_once)
    for (std::size_t b = 0; b < blocks.blocks(); ++b) {
      const int orders = std::min(at_once, degree + 1 - k);
      for (int order = k; order < k + orders; ++order)
        for (const auto& [place, input] : program.inputs)
          for (int lane = 0; lane < blocks.lanes(); ++lane)
            blocks.at(b, place, order)[lane] = operands[blocks.element(b, lane)][input.component][order];
      blocks.run(b, k, orders);
      for (int order = k; order < k + orders; ++order)
        for (int lane = 0; lane < blocks.lanes(); ++lane)
          results[blocks.element(b, lane)][order] = blocks.at(b, program.outputs[0], order)[lane];
    }
  return results;
}

/// All tables of this machine: every instruction set in every width of a block.
inline std::vector<const KernelTable<double>*> tables_of_all_widths() {
  std::vector<const KernelTable<double>*> all;
  for (const auto* widest : available_kernels())
    for (const auto* table = widest; table; table = table->narrower) all.push_back(table);
  return all;
}
inline std::string name(const KernelTable<double>& table) {
  return std::string(table.instruction_set) + ", " + std::to_string(table.lanes) + " lanes";
}

}  // namespace jetlag::testing
