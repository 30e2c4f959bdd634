// SPDX-License-Identifier: MIT
#include "integrators/random_ensemble.hpp"

#include <Random123/philox.h>

#include <atomic>
#include <cmath>
#include <stdexcept>

#include "integrators/pool.hpp"
#include "jetlag/control/fixed_step.hpp"

namespace jetlag {

namespace {

/// Each member by itself: a few RandomTaylor go from member to member.
class OneByOne final : public RandomEnsemble::Members {
 public:
  OneByOne(const System<double>& system, SeriesMethod method, const std::vector<State<double>>& states,
           std::uint64_t max_steps)
      : Members(states.size()),
        system_(system),
        method_(std::move(method)),
        states_(states),
        members_(states.size()),
        steps_(states.size(), 0),
        max_steps_(max_steps) {
    method_.options.threads = 1;
    for (std::size_t i = 0; i < states.size(); ++i)
      members_[i] = {member_seed(method_.options.seed, i), 0, method_.control->clone()};
    for (State<double>& state : states_) state.drop_rests();
  }

  bool in_lanes() const override { return false; }
  std::size_t tasks() const override { return states_.size(); }
  State<double> state(std::size_t i) const override { return states_[i]; }

  void advance(std::size_t i, double until, const std::function<bool()>& go_on) override {
    State<double>& state = states_[i];
    if (reports[i].outcome != Outcome::success || state.time >= until) return;
    auto taylor = pool_.lend([&] {
      return std::make_unique<RandomTaylor>(system_, method_.law, method_.control->clone(), method_.options);
    });
    taylor->exchange(members_[i]);
    while (state.time < until && reports[i].outcome == Outcome::success && (!go_on || go_on())) {
      if (steps_[i] >= max_steps_) {
        reports[i] = step_limit(max_steps_, state.time);
        break;
      }
      const double limit = until - state.time, h = taylor->step(state, limit, reports[i]);
      if (reports[i].outcome != Outcome::success) break;
      state.time = h == limit ? until : state.time + h;
      ++steps_[i];
    }
    taylor->exchange(members_[i]);
    pool_.give_back(std::move(taylor));
  }

  Work work() const override {
    Work all;
    pool_.each([&](const RandomTaylor& taylor) { add(taylor.work(), all); });
    return all;
  }

 private:
  System<double> system_;
  SeriesMethod method_;
  std::vector<State<double>> states_;
  std::vector<RandomTaylor::Member> members_;
  std::vector<std::uint64_t> steps_;
  std::uint64_t max_steps_;
  Pool<RandomTaylor> pool_;
};

void check(const System<double>& system, const std::vector<State<double>>& states) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    require_shape(states[i], system.particles(), system.dimension());
    const auto refuse = [&](const std::string& what) {
      throw std::invalid_argument("RandomEnsemble: " + what + " of state " + std::to_string(i));
    };
    if (!std::isfinite(states[i].time) || states[i].time != states[0].time)
      refuse("the time must be finite and the same for all, not so that");
    for (int p = 0; p < system.particles(); ++p)
      if (system.fixed()[p] && !(states[i].velocity.row(p).array() == 0.0).all())
        refuse("particle " + std::to_string(p) + " is fixed and must be at rest, not so in that");
  }
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

Report step_limit(std::uint64_t max_steps, double time) {
  return {Outcome::step_limit,
          "the largest number of steps, " + std::to_string(max_steps) +
              ", is used up at t = " + std::to_string(time) + "; allow more or take longer steps",
          -1};
}

void add(const Work& work, Work& to) {
  to.steps += work.steps;
  to.updates += work.updates;
  to.coefficients += work.coefficients;
  to.element_coefficients += work.element_coefficients;
  to.degrees += work.degrees;
  to.rejected += work.rejected;
}

RandomEnsemble::RandomEnsemble(const System<double>& system, const SeriesMethod& method,
                               const std::vector<State<double>>& states, const Options& options)
    : workers_(options.workers) {
  check(system, states);
  const bool possible =
      !method.options.compensated && dynamic_cast<const FixedStep*>(method.control.get()) != nullptr;
  if (options.layout == Layout::in_lanes && !possible)
    throw std::invalid_argument("RandomEnsemble: lanes need a FixedStep and sums that are not compensated");
  const bool lanes = options.layout == Layout::in_lanes ||
                     (options.layout == Layout::automatic && possible && fits_lanes(system));
  if (lanes)
    members_ = members_in_lanes(system, method, states, options.max_steps);
  else
    members_ = std::make_unique<OneByOne>(system, method, states, options.max_steps);
}

RandomEnsemble::~RandomEnsemble() = default;
RandomEnsemble::RandomEnsemble(RandomEnsemble&&) noexcept = default;
RandomEnsemble& RandomEnsemble::operator=(RandomEnsemble&&) noexcept = default;

bool RandomEnsemble::advance_to(double until, const std::function<bool()>& go_on) {
  if (!std::isfinite(until))
    throw std::invalid_argument("RandomEnsemble: the time to advance to must be finite");
  std::atomic<bool> stopped = false;
  const std::function<bool()> watched = [&] {
    if (!stopped && !go_on()) stopped = true;
    return !stopped;
  };
  const std::function<bool()> none;
  workers_.each(members_->tasks(),
                [&](std::size_t task) { members_->advance(task, until, go_on ? watched : none); });
  return !stopped;
}

std::size_t RandomEnsemble::size() const { return members_->reports.size(); }
bool RandomEnsemble::in_lanes() const { return members_->in_lanes(); }
Work RandomEnsemble::work() const { return members_->work(); }

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
