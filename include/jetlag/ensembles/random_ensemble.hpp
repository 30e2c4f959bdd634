// SPDX-License-Identifier: MIT
#pragma once
// Random ensembles: many members of one motion, each with random degrees of its own.
//
//   RandomEnsemble ensemble(system, {geometric(3, 6, 0.5), {.seed = 7}, std::make_shared<FixedStep>(0.01)}, states);
//   ensemble.advance_to(1.0);
//   ensemble.state(12).position;
//
// The spread of the members is what random truncation tells about its own error. Of a small system with a fixed step
// the members run in the lanes of the processor, the whole system one tape; of others each by itself. Either way
// threads share them.

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "jetlag/base/workers.hpp"
#include "jetlag/integrators/taylor.hpp"

namespace jetlag {

/// What makes a RandomTaylor of a system.
struct SeriesMethod {
  Truncation law;
  RandomTaylor::Options options;
  std::shared_ptr<const Control> control;  // each member gets a clone
};

/// The seed of a member: 64 bits of Philox4x32-10 of (seed, member), another stream than the draws. Members of one seed
/// are far apart, and so are those of neighbouring seeds.
std::uint64_t member_seed(std::uint64_t seed, std::uint64_t member);

class RandomEnsemble {
 public:
  enum class Layout { automatic, in_lanes, one_by_one };

  struct Options {
    Workers workers{1};
    std::uint64_t max_steps = std::numeric_limits<std::uint64_t>::max();  // of each member
    double end = std::numeric_limits<
        double>::infinity();  // [s]: the last step of each member is shortened to end there
    Layout layout = Layout::automatic;
  };

  /// The state in which a member starts.
  using Start = std::function<State<double>(std::size_t member)>;

  /// Member i starts at states[i] and draws with member_seed(method.options.seed, i): it has the same bits in any
  /// company and for any number of workers. In lanes and one by one it agrees to rounding.
  /// Keeps no reference to the system. The states have one time; their rests are dropped.
  /// Throws std::invalid_argument for a state of another shape, a fixed particle that is not at rest and times that
  /// differ or are not finite; for Layout::in_lanes with compensated sums, a control that is not FixedStep, or forces that make
  /// choices (forces/force.hpp) other than roots: these come to zero at points, which lanes may step over.
  RandomEnsemble(const System<double>& system, const SeriesMethod& method,
                 const std::vector<State<double>>& states, const Options& options);
  RandomEnsemble(const System<double>& system, const SeriesMethod& method,
                 const std::vector<State<double>>& states)
      : RandomEnsemble(system, method, states, Options{}) {}
  /// As above for `members` states that are made one after the other and not kept besides.
  RandomEnsemble(const System<double>& system, const SeriesMethod& method, std::size_t members,
                 const Start& start, const Options& options);
  ~RandomEnsemble();
  RandomEnsemble(RandomEnsemble&&) noexcept;
  RandomEnsemble& operator=(RandomEnsemble&&) noexcept;

  /// Every member goes to `until` [s] or Options::end, whichever is earlier: it takes the steps that lead there or beyond,
  /// and its state is that of the last step's polynomial. Where one looks does not change the motion.
  /// A member that fails keeps the state before the step that failed, says so in its report, and goes no further; the
  /// others do not notice.
  /// go_on: asked now and then, by any thread; once it is false members stay on their way, and their states are those of
  /// before. Returns whether all have arrived. Throws std::invalid_argument for a time that is not finite or lies before
  /// that of the states.
  bool advance_to(double until, const std::function<bool()>& go_on = {});

  std::size_t size() const;
  bool in_lanes() const;
  State<double> state(std::size_t i) const;
  /// success, step_underflow, non_finite or step_limit.
  const Report& report(std::size_t i) const;

  /// Of all members so far. In lanes, orders are computed up to the largest degree in a block of members, for all.
  Work work() const;

  /// The orders of the forces that a step of a member computes by itself, on average over the steps of all so far; 0
  /// before the first: what the method costs, the same in lanes and one by one. Of Taylor's method of degree N: N, or N
  /// - 1 with `derivative`.
  double mean_orders() const;

  /// The memory that an ensemble of this method keeps for each member [bytes], to some 10 %.
  static double bytes_of_a_member(const System<double>& system, const SeriesMethod& method);

  class Members;

 private:
  std::unique_ptr<Members> members_;
  Workers workers_;
  double time_;  // of the states
  double end_;
};

}  // namespace jetlag
