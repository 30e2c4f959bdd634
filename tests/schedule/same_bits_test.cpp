// SPDX-License-Identifier: MIT
// Clocks of their own give the same bits wherever a run is stopped, whatever its particles are called, and for any
// number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <numeric>
#include <ostream>
#include <string>
#include <vector>

#include "jetlag/schedule/asynchronous.hpp"
#include "jetlag/schedule/block.hpp"
#include "schedule/networks.hpp"
#include "studies/clocks/collapsing_body.hpp"

namespace jetlag::testing::same_bits_test {
namespace {

struct Member {
  std::string name;
  std::function<std::unique_ptr<ParticleClocks>(const System<double>&, const TruncationLaw&, int threads)>
      make;
};
void PrintTo(const Member& member, std::ostream* out) { *out << member.name; }

template <class ScheduleType>
std::unique_ptr<ParticleClocks> with_clocks(const System<double>& system, const TruncationLaw& law,
                                            int threads) {
  typename ScheduleType::Options options;
  options.tolerance = 1e-8;
  options.threads = threads;
  return std::make_unique<ScheduleType>(system, law, options);
}

class SameBits : public ::testing::TestWithParam<Member> {};
INSTANTIATE_TEST_SUITE_P(Of, SameBits,
                         ::testing::Values(Member{"Block", with_clocks<BlockSteps>},
                                           Member{"Asynchronous", with_clocks<Asynchronous>}),
                         [](const auto& info) { return info.param.name; });

const TruncationLaw laws[] = {fixed_degree(8), geometric(4, 8, 0.5)};

TEST_P(SameBits, WhereverARunIsStopped) {
  // After one event, after two, after three, ... each time by a new schedule, which then goes on to the end.
  const Problem scene = stiff_spot_in_a_chain(8, 100);
  for (const TruncationLaw& law : laws) {
    const auto whole = GetParam().make(scene.system, law, 1);
    State<double> end = scene.start;
    ASSERT_EQ(whole->run(end, 1.0, {}).outcome, Outcome::success);
    const std::uint64_t events = whole->work().steps;
    EXPECT_GT(events, 50u);
    for (std::uint64_t stop = 1; stop < events; ++stop) {
      const auto schedule = GetParam().make(scene.system, law, 1);
      State<double> state = scene.start;
      RunOptions options;
      options.max_steps = stop;
      ASSERT_EQ(schedule->run(state, 1.0, options).outcome, Outcome::step_limit);
      ASSERT_EQ(schedule->run(state, 1.0, {}).outcome, Outcome::success);
      ASSERT_EQ(state.position, end.position) << stop;
      ASSERT_EQ(state.velocity, end.velocity) << stop;
      ASSERT_EQ(schedule->work().updates, whole->work().updates) << stop;
    }
  }
}

TEST_P(SameBits, WhateverParticlesAreCalled) {
  // Ties are in the order of numbers: at tick 0 all are due at once, and many are later. The elements keep their order, so
  // that each particle's forces are summed in the same one.
  const Problem scene = stiff_spot_in_a_chain(24, 1e3);
  const int particles = scene.system.particles();
  for (const TruncationLaw& law : laws) {
    State<double> one = scene.start;
    ASSERT_EQ(GetParam().make(scene.system, law, 1)->run(one, 1.0, {}).outcome, Outcome::success);
    for (const auto& [factor, shift] :
         {std::pair(25, 25), std::pair(7, 3), std::pair(11, 20)}) {  // odd, not 13
      std::vector<int> number(particles);
      for (int i = 0; i < particles; ++i) number[i] = (i * factor + shift) % particles;
      const Problem other = renumbered(scene, number);
      State<double> state = other.start;
      ASSERT_EQ(GetParam().make(other.system, law, 1)->run(state, 1.0, {}).outcome, Outcome::success);
      for (int i = 0; i < particles; ++i) {
        EXPECT_EQ(state.position(number[i], 0), one.position(i, 0)) << i;
        EXPECT_EQ(state.velocity(number[i], 0), one.velocity(i, 0)) << i;
      }
    }
  }
}

TEST_P(SameBits, ForAnyNumberOfThreads) {
  // Of the 4184 springs of a body, all at once as long as all are due at once.
  const Mesh mesh = truncated_ellipsoid({0.8, 1.2, 0.8}, {8, 8}, 0.9, 0.95);
  const System<double> system = springs_on(mesh);
  State<double> start{0.0, mesh.position, Coordinates<double>(mesh.position.rows(), 3)};
  for (int i = 0; i < start.velocity.rows(); ++i)
    for (int c = 0; c < 3; ++c) start.velocity(i, c) = 0.01 * standard_normal(1, i, c);
  State<double> one = start;
  ASSERT_EQ(GetParam().make(system, laws[0], 1)->run(one, 0.25, {}).outcome, Outcome::success);
  for (const int threads : {2, 3}) {
    State<double> state = start;
    ASSERT_EQ(GetParam().make(system, laws[0], threads)->run(state, 0.25, {}).outcome, Outcome::success);
    EXPECT_EQ(state.position, one.position) << threads;
    EXPECT_EQ(state.velocity, one.velocity) << threads;
  }
}

TEST_P(SameBits, UpToRoundingForAnyOrderOfElements) {
  // Seven springs at each particle, of forces below 3 x 0.2 N: sums in another order differ by 7 roundings of 1.1e-16 x
  // 0.6 x 7 in each coefficient, 3e-15 m/s^2, which moves a mass of 1 kg by as much in a second or two. No step lies
  // so near to a power of two that this decides it: the updates are the same.
  const Problem scene = spring_cube(3);
  System<double> reversed(3, scene.system.mass());
  for (Elements<double> elements : scene.system.elements()) {
    const std::size_t count = elements.count(), ends = 2, numbers = elements.parameters.size() / count;
    Elements<double> turned = elements;
    for (std::size_t e = 0; e < count; ++e) {
      std::copy_n(elements.particles.begin() + e * ends, ends,
                  turned.particles.begin() + (count - 1 - e) * ends);
      std::copy_n(elements.parameters.begin() + e * numbers, numbers,
                  turned.parameters.begin() + (count - 1 - e) * numbers);
    }
    reversed.add(turned.law, turned.particles, turned.parameters);
  }
  State<double> one = scene.start, other = scene.start;
  const auto a = GetParam().make(scene.system, laws[0], 1), b = GetParam().make(reversed, laws[0], 1);
  ASSERT_EQ(a->run(one, 1.0, {}).outcome, Outcome::success);
  ASSERT_EQ(b->run(other, 1.0, {}).outcome, Outcome::success);
  EXPECT_LT((one.position - other.position).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_NE(one.position, other.position);  // it is another order
  EXPECT_EQ(a->work().updates, b->work().updates);
}

}  // namespace
}  // namespace jetlag::testing::same_bits_test
