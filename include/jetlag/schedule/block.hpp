// SPDX-License-Identifier: MIT
#pragma once
// Block steps: clocks on powers of two, so that they meet often, and whoever is due together is expanded together.
//
//     level 0   |-------------------------------|       steps of T / 2^level; a step of level l begins at a multiple
//     level 1   |---------------|---------------|       of itself, so that blocks nest: a neighbour's polynomial never
//     level 3   |---|---|---|---|---|---|---|---|       ends before the step of the finer particle does
//
// A particle takes the level its own series asks for (control/last_two.hpp). It may become finer at any of its
// updates by any number of levels, coarser by one level and only where that step may begin. At its update it is
// at most `grading` levels coarser than any neighbour. (A neighbour that is not due stays too coarse until it is: woken
// at an odd tick it would have to begin with the finest step, and so would its own neighbours; measured on a
// chain of 128 masses with four stiff springs, degree 8: four times the updates.) Only at a kink of a force
// (model/kinks.hpp) are neighbours woken: there a series departs from what they rely on. They are due at the coarsest
// tick up to which it does so by less than the tolerance, and counted in Work::wake_ups.
//
// Source: individual steps in blocks, Makino, Aarseth 1992 (S. J. Aarseth, Gravitational N-Body Simulations, 2003);
// there the others are predicted and the force is summed anew, here the series of all that are due are grown together.

#include <cstdint>
#include <memory>
#include <vector>

#include "jetlag/model/kinks.hpp"
#include "jetlag/schedule/particle_clocks.hpp"

namespace jetlag {

class BlockSteps final : public ParticleClocks {
 public:
  struct Options : ClockOptions {
    int grading = 1;  // >= 0; 0: neighbours may differ by any number of levels
  };

  /// Throws std::invalid_argument.
  BlockSteps(const System<double>& system, TruncationLaw law, const Options& options);
  BlockSteps(const System<double>& system, int degree, const Options& options)
      : BlockSteps(system, fixed_degree(degree), options) {}
  ~BlockSteps() override;

  /// The level of a particle: its step is 2^-level of the longest.
  int level_of(int particle) const { return level_[particle]; }

 private:
  struct Group;

  void begin_clocks() override;
  std::int64_t due() const override { return next_; }
  bool update(Report& report) override;
  const std::vector<int>& updated() const override { return *updated_; }
  std::int64_t step_of(int particle) const override;

  int lowest_from(int level) const;
  const std::vector<int>& due_from(int level);
  Group& group_from(int level);
  bool choose_levels(const std::vector<int>& updated, std::int64_t now, Report& report);
  void limit_differences(const std::vector<int>& updated);
  void wake_neighbours(std::int64_t now);
  void move(int particle, int from, int to);

  int grading_;
  std::int64_t next_ = 0, now_ = 0;  // ticks of the next update and of the last one
  bool begun_ = false;
  const std::vector<int>* updated_ = nullptr;
  std::vector<int> level_, place_;          // of each particle, and its place among those of its level
  std::vector<std::vector<int>> of_level_;  // particles
  std::vector<std::unique_ptr<Group>>
      groups_;                        // all particles from a level on, by that level; null: not yet made
  std::vector<int> before_;           // levels before an update
  std::vector<int> raised_, chosen_;  // room for an update
  std::vector<Kinks::Step> shortened_;
  std::vector<std::pair<int, int>> woken_;  // particles, and the levels to which they are woken
};

}  // namespace jetlag
