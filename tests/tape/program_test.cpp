// SPDX-License-Identifier: MIT
// Blocks of elements: room, lanes beyond the last element, parameters.
#include "jetlag/tape/program.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "jetlag/tape/recording.hpp"

namespace jetlag::testing {
namespace {

/// f = p exp(x): one history of x, one of exp(x).
Tape scaled_exponential() {
  Recording recording;
  const Recorded x = recording.input({Input::Kind::position, 0, 0});
  return recording.finish({recording.parameter(0) * exp(x)});
}

/// Coefficient k of p exp(t) for each element.
std::vector<double> coefficient(Blocks<double>& blocks, int k) {
  std::vector<double> values(blocks.count());
  for (std::size_t b = 0; b < blocks.blocks(); ++b) {
    for (int lane = 0; lane < blocks.lanes(); ++lane)
      blocks.at(b, blocks.program().inputs[0].place, k)[lane] = k == 1;
    blocks.run(b, k);
    for (int lane = 0; lane < blocks.lanes(); ++lane)
      values[blocks.element(b, lane)] = blocks.at(b, blocks.program().outputs[0], k)[lane];
  }
  return values;
}

TEST(Blocks, GiveEachElementItsOwnParameters) {
  for (const auto* table : available_kernels()) {
    std::vector<double> parameters;
    for (int e = 0; e < 45; ++e) parameters.push_back(1.0 + e);
    Blocks<double> blocks(Program(scaled_exponential()), 45, parameters, *table);
    blocks.reserve(2);
    EXPECT_EQ(coefficient(blocks, 0), parameters) << table->instruction_set;  // p exp(0) = p
    EXPECT_EQ(coefficient(blocks, 1), parameters) << table->instruction_set;
  }
}

TEST(Blocks, KeepWhatIsKnownWhenTheyMakeRoom) {
  for (const auto* table : available_kernels()) {
    Blocks<double> grown(Program(scaled_exponential()), 45, std::vector(45, 3.0), *table);
    Blocks<double> ample(Program(scaled_exponential()), 45, std::vector(45, 3.0), *table);
    ample.reserve(20);
    for (int k = 0; k < 20; ++k) {
      grown.reserve(k + 1);
      EXPECT_EQ(coefficient(grown, k), coefficient(ample, k)) << table->instruction_set << ", order " << k;
    }
  }
}

TEST(Blocks, FillTheLastBlockWithTheLastElement) {
  const auto& table = *available_kernels().back();
  const std::size_t count = table.lanes + 1;
  Blocks<double> blocks(Program(scaled_exponential()), count, std::vector(count, 2.0), table);
  ASSERT_EQ(blocks.blocks(), 2u);
  for (int lane = 0; lane < blocks.lanes(); ++lane) {
    EXPECT_EQ(blocks.element(0, lane), static_cast<std::size_t>(lane));
    EXPECT_EQ(blocks.element(1, lane), count - 1);
  }
}

TEST(Blocks, RefuseAWrongNumberOfParameters) {
  EXPECT_THROW(Blocks<double>(Program(scaled_exponential()), 2, {1.0}, scalar_kernels<double>()),
               std::invalid_argument);
}

TEST(Blocks, HoldTheBytesOfTheirSeries) {
  // 2 histories of 8 orders, 1 parameter, 1 scratch of two orders, in one lane; exp has 2 operands, scale 3
  Blocks<double> blocks(Program(scaled_exponential()), 1, {1.0}, scalar_kernels<double>());
  EXPECT_EQ(blocks.bytes(), sizeof(double) * (1 + 2));
  blocks.reserve(8);
  EXPECT_EQ(blocks.bytes(), sizeof(double) * (2 * 8 + 1 + 2) + 5 * sizeof(Operand<double>));
}

TEST(Blocks, ComputeWhatHasNoSeriesOnce) {  // sqrt(p) x with sqrt(p) among the statics
  Recording recording;
  const Recorded x = recording.input({Input::Kind::position, 0, 0});
  const Program program(recording.finish({sqrt(recording.parameter(0)) * x}));
  EXPECT_EQ(program.preparation.size(), 1u);
  EXPECT_EQ(program.instructions.size(), 1u);
  Blocks<double> blocks(program, 1, {9.0}, scalar_kernels<double>());
  blocks.reserve(3);
  for (int k = 0; k < 3; ++k) {
    *blocks.at(0, program.inputs[0].place, k) = k + 1.0;
    blocks.run(0, k);
    EXPECT_EQ(*blocks.at(0, program.outputs[0], k), 3.0 * (k + 1));
  }
}

}  // namespace
}  // namespace jetlag::testing
