// SPDX-License-Identifier: MIT
#include <Random123/philox.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>

#include "base/pool.hpp"
#include "ensembles/members.hpp"
#include "jetlag/base/text.hpp"
#include "jetlag/control/fixed_step.hpp"
#include "jetlag/series/functions.hpp"

namespace jetlag {

namespace {

/// Each member by itself: a few RandomTaylor go from member to member.
class OneByOne final : public RandomEnsemble::Members {
 public:
  OneByOne(const System<double>& system, SeriesMethod method, std::size_t count,
           const RandomEnsemble::Start& start, const RandomEnsemble::Options& options)
      : Members(count), system_(system), method_(std::move(method)), options_(options) {
    method_.options.threads = 1;
    members_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      Member& member = members_[i];
      member.draws.seed = member_seed(method_.options.seed, i);
      member.draws.control = method_.control->clone();
      member.state = start(i);
      member.state.drop_rests();
      member.begin = member.seen = member.state;
    }
  }

  bool in_lanes() const override { return false; }
  std::size_t tasks() const override { return members_.size(); }
  State<double> state(std::size_t i) const override {
    return reports[i].outcome == Outcome::success ? members_[i].seen : members_[i].state;
  }

  void advance(std::size_t i, double until, const std::function<bool()>& go_on) override {
    Member& member = members_[i];
    State<double>& state = member.state;
    Report& report = reports[i];
    if (report.outcome != Outcome::success) return;
    if (state.time >= until) return look_again(member, until);
    auto taylor = lend(steppers_);
    taylor->exchange(member.draws);
    while (state.time < until && (!go_on || go_on())) {
      if (member.steps >= options_.max_steps) {
        report = step_limit(options_.max_steps, state.time);
        break;
      }
      const double limit = options_.end - state.time;
      member.begin = state;
      member.length = taylor->step(state, limit, report);
      if (report.outcome != Outcome::success) break;
      state.time = member.length == limit ? options_.end : state.time + member.length;
      ++member.steps;
      if (state.time >= until) member.seen = state.time == until ? state : taylor->piece().at(until);
    }
    taylor->exchange(member.draws);
    steppers_.give_back(std::move(taylor));
  }

  Work work() const override {
    Work all;
    steppers_.each([&](const RandomTaylor& taylor) { all += taylor.work(); });
    return all;
  }
  std::uint64_t orders() const override {
    const Work all = work();  // coefficients: one for each moving particle
    return all.updates == 0 ? 0 : all.coefficients / (all.updates / all.steps);
  }

 private:
  struct Member {
    RandomTaylor::Member draws;
    State<double> state, begin,
        seen;           // at the end and at the beginning of the last step, and where it was looked at
    double length = 0;  // of the last step
    std::uint64_t steps = 0;
  };

  std::unique_ptr<RandomTaylor> lend(Pool<RandomTaylor>& pool) {
    return pool.lend([&] {
      return std::make_unique<RandomTaylor>(system_, method_.law, method_.control->clone(), method_.options);
    });
  }

  /// The state at a time of the last step, which is taken once more: same state and update, same bits.
  void look_again(Member& member, double time) {
    if (time == member.state.time || member.steps == 0) {
      member.seen = member.state;
      return;
    }
    auto taylor = lend(lookers_);
    RandomTaylor::Member before;
    before.seed = member.draws.seed;
    before.update = member.draws.update - 1;
    before.control = std::make_unique<FixedStep>(member.length);
    taylor->exchange(before);
    State<double> state = member.begin;
    Report report;
    taylor->step(state, member.length, report);
    member.seen = taylor->piece().at(time);
    taylor->exchange(before);
    lookers_.give_back(std::move(taylor));
  }

  System<double> system_;
  SeriesMethod method_;
  RandomEnsemble::Options options_;
  std::vector<Member> members_;
  Pool<RandomTaylor> steppers_, lookers_;  // the work of the first ones counts
};

void check(const System<double>& system, const State<double>& state, std::size_t i, double time) {
  require_shape(state, system.particles(), system.dimension());
  const auto refuse = [&](const std::string& what) {
    throw std::invalid_argument("RandomEnsemble: " + what + " of state " + std::to_string(i));
  };
  if (!std::isfinite(state.time) || state.time != time)
    refuse("the time must be finite and the same for all, not so that");
  for (int p = 0; p < system.particles(); ++p)
    if (system.fixed()[p] && !(state.velocity.row(p).array() == 0.0).all())
      refuse("particle " + std::to_string(p) + " is fixed and must be at rest, not so in that");
}

/// Whether a force makes choices besides those of its roots, which come to zero at points, as the ends of a spring that meet.
bool makes_choices(const Tape& force) {
  return std::ranges::any_of(force.conditions, [&](const Condition& condition) {
    const int rule = force.nodes[condition.node].rule;
    return rule != rule_id<Sqrt> && rule != rule_id<RootOfScaled> && rule != rule_id<Power>;
  });
}

/// Whether members can go in lanes, whose steps do not end where choices in forces change.
bool allows_lanes(const System<double>& system, const SeriesMethod& method) {
  const bool has_choices = std::ranges::any_of(system.elements(), [](const Elements<double>& elements) {
    return elements.count() > 0 && makes_choices(elements.law.force);
  });
  return !has_choices && !method.options.compensated && std::holds_alternative<TruncationLaw>(method.law) &&
         dynamic_cast<const FixedStep*>(method.control.get()) != nullptr;
}

}  // namespace

std::uint64_t member_seed(std::uint64_t seed, std::uint64_t member) {
  using Philox = r123::Philox4x32;
  const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
  const auto high = [](std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); };
  constexpr std::uint32_t stream = 0x6d656d62;
  const auto bits = Philox()({{low(member), high(member), 0, stream}}, {{low(seed), high(seed)}});
  return static_cast<std::uint64_t>(bits[0]) << 32 | bits[1];
}

RandomEnsemble::RandomEnsemble(const System<double>& system, const SeriesMethod& method,
                               const std::vector<State<double>>& states, const Options& options)
    : RandomEnsemble(system, method, states.size(), [&](std::size_t i) { return states[i]; }, options) {}

RandomEnsemble::RandomEnsemble(const System<double>& system, const SeriesMethod& method, std::size_t members,
                               const Start& start, const Options& options)
    : workers_(options.workers), time_(members == 0 ? 0.0 : start(0).time), end_(options.end) {
  const Start checked = [&](std::size_t i) {
    State<double> state = start(i);
    check(system, state, i, time_);
    return state;
  };
  if (std::isfinite(time_) && !(options.end >= time_))
    throw std::invalid_argument("RandomEnsemble: the end lies before the states");
  if (options.layout == Layout::in_lanes && !allows_lanes(system, method))
    throw std::invalid_argument(
        "RandomEnsemble: lanes need a FixedStep, sums that are not compensated, a law that is known "
        "beforehand, and forces without choices (select, abs, min, max)");
  const bool lanes =
      options.layout == Layout::in_lanes ||
      (options.layout == Layout::automatic && allows_lanes(system, method) && fits_lanes(system));
  if (lanes)
    members_ = members_in_lanes(system, method, members, checked, options);
  else
    members_ = std::make_unique<OneByOne>(system, method, members, checked, options);
}

RandomEnsemble::~RandomEnsemble() = default;
RandomEnsemble::RandomEnsemble(RandomEnsemble&&) noexcept = default;
RandomEnsemble& RandomEnsemble::operator=(RandomEnsemble&&) noexcept = default;

bool RandomEnsemble::advance_to(double until, const std::function<bool()>& go_on) {
  if (!std::isfinite(until))
    throw std::invalid_argument("RandomEnsemble: the time to advance to must be finite");
  if (until < time_)
    throw std::invalid_argument("RandomEnsemble: the time to advance to lies before that of the states");
  until = std::min(until, end_);
  std::atomic<bool> stopped = false;
  const std::function<bool()> watched = [&] {
    if (!stopped && !go_on()) stopped = true;
    return !stopped;
  };
  const std::function<bool()> none;
  workers_.each(members_->tasks(),
                [&](std::size_t task) { members_->advance(task, until, go_on ? watched : none); });
  if (!stopped) time_ = until;
  return !stopped;
}

std::size_t RandomEnsemble::size() const { return members_->reports.size(); }
bool RandomEnsemble::in_lanes() const { return members_->in_lanes(); }
Work RandomEnsemble::work() const { return members_->work(); }

double RandomEnsemble::mean_orders() const {
  const std::uint64_t steps = members_->work().steps;
  return steps == 0 ? 0.0 : static_cast<double>(members_->orders()) / static_cast<double>(steps);
}

/// Three states, and their rests with compensated sums, and half of one that is left free in the heaps of threads; a
/// report, a control, draws and what the heap adds to each. Measured: 34.8 kB a member of 273 particles in a plane.
double RandomEnsemble::bytes_of_a_member(const System<double>& system, const SeriesMethod& method) {
  constexpr double besides = 600;
  const double numbers = 2.0 * system.particles() * system.dimension();
  return besides + 3.5 * (method.options.compensated ? 2 : 1) * numbers * sizeof(double);
}

const Report& RandomEnsemble::report(std::size_t i) const {
  if (i >= size())
    throw std::invalid_argument("RandomEnsemble: member " + std::to_string(i) +
                                " does not exist, there are " + std::to_string(size()));
  return members_->reports[i];
}

State<double> RandomEnsemble::state(std::size_t i) const {
  report(i);
  return members_->state(i);
}

}  // namespace jetlag
