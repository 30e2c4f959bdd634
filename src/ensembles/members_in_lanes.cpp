// SPDX-License-Identifier: MIT
// Members in lanes: the whole system is one tape, a member an element of it. All members have one step and one time.
#include <algorithm>
#include <cmath>
#include <span>

#include "base/pool.hpp"
#include "ensembles/members.hpp"
#include "ensembles/stopped_lanes.hpp"
#include "jetlag/control/fixed_step.hpp"

namespace jetlag {

namespace {

/// Elements of a system up to which lanes are faster for sure. Measured, degrees 3 to 6 and 3 to 12, springs and drag:
/// a step of 8 elements takes 0.19 and 0.28 us a member in lanes, 0.78 and 0.82 us one by one; one of 100 elements 2.3
/// and 3.4 in lanes, 3.1 and 3.1 one by one; one of 560 elements 19 and 30 in lanes, 14 and 15 one by one.
constexpr std::size_t most_elements = 100;

class MembersInLanes final : public RandomEnsemble::Members {
 public:
  MembersInLanes(const System<double>& system, const SeriesMethod& method, std::size_t count,
                 const RandomEnsemble::Start& start, const RandomEnsemble::Options& options);

  bool in_lanes() const override { return true; }
  std::size_t tasks() const override { return blocks_.size(); }
  void advance(std::size_t block, double until, const std::function<bool()>& go_on) override;
  State<double> state(std::size_t i) const override;
  Work work() const override {
    Work all;
    for (const Block& block : blocks_) all += block.work;
    return all;
  }
  std::uint64_t orders() const override {
    std::uint64_t all = 0;
    for (const Block& block : blocks_) all += block.orders;
    return all;
  }

 private:
  struct alignas(64) Block {
    double time = 0;
    std::uint64_t update = 0;
    Work work;
    std::uint64_t orders = 0;                              // that its members would compute one by one
    AlignedVector<double> position, velocity;              // [component][lane]
    double begin = 0;                                      // of the last step
    AlignedVector<double> begin_position, begin_velocity;  // there
    double seen = 0;                                       // the time that was looked at
    AlignedVector<double> seen_position, seen_velocity;    // there
  };
  void look(std::size_t first, double time, Block& block, StoppedLanes& lanes) const;
  std::unique_ptr<StoppedLanes> lend() {
    return pool_.lend([&] { return std::make_unique<StoppedLanes>(system_, law_, options_, *table_); });
  }
  std::span<const std::uint64_t> seeds(std::size_t first) const { return std::span(seeds_).subspan(first); }

  SystemLanes system_;
  Truncation law_;
  RandomTaylor::Options options_;
  double step_;
  const KernelTable<double>* table_;
  int lanes_, moving_;
  std::uint64_t max_steps_;
  double end_;
  std::vector<std::uint64_t> seeds_;  // of the draws of each member
  std::vector<double> stopped_;       // the time of each member that has failed
  std::vector<Block> blocks_;
  Pool<StoppedLanes> pool_;
};

MembersInLanes::MembersInLanes(const System<double>& system, const SeriesMethod& method, std::size_t count,
                               const RandomEnsemble::Start& start, const RandomEnsemble::Options& options)
    : Members(count),
      system_(system),
      law_(method.law),
      options_(method.options),
      step_(dynamic_cast<const FixedStep&>(*method.control).step()),
      table_(&kernels<double>()),  // of one width, whatever the number of members: the same bits
      lanes_(table_->lanes),
      moving_(moving_particles(system)),
      max_steps_(options.max_steps),
      end_(options.end) {
  for (std::size_t i = 0; i < count; ++i) seeds_.push_back(member_seed(options_.seed, i));
  pool_.give_back(lend());  // throws what is to be thrown
  stopped_.resize(count);
  blocks_.resize((count + lanes_ - 1) / lanes_);
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    Block& block = blocks_[b];
    block.position.resize(static_cast<std::size_t>(system_.components) * lanes_);
    block.velocity.resize(block.position.size());
    State<double> state;
    for (int lane = 0; lane < lanes_; ++lane) {  // lanes beyond the last member repeat it
      if (b * lanes_ + lane < count) state = start(b * lanes_ + lane);
      block.time = block.begin = block.seen = state.time;
      for (int c = 0; c < system_.components; ++c) {
        block.position[c * lanes_ + lane] = state.position.data()[c];
        block.velocity[c * lanes_ + lane] = state.velocity.data()[c];
      }
    }
    block.begin_position = block.seen_position = block.position;
    block.begin_velocity = block.seen_velocity = block.velocity;
  }
}

void MembersInLanes::advance(std::size_t number, double until, const std::function<bool()>& go_on) {
  Block& block = blocks_[number];
  const std::size_t first = number * lanes_;
  const int active = static_cast<int>(std::min<std::size_t>(lanes_, reports.size() - first));
  std::vector<char> moves(lanes_, 0);
  int moving = 0;
  for (int i = 0; i < active; ++i) moving += moves[i] = reports[first + i].outcome == Outcome::success;
  const auto end = [&](int i, Report report) {
    reports[first + i] = std::move(report);
    stopped_[first + i] = block.time;
    moves[i] = 0;
    --moving;
  };
  auto lanes = lend();
  while (block.time < until && moving > 0 && (!go_on || go_on())) {
    const double h = cropped(step_, end_ - block.time);
    if (block.update >= max_steps_ || !advances(block.time, h)) {
      for (int i = 0; i < active; ++i)
        if (moves[i])
          end(i, block.update >= max_steps_
                     ? step_limit(max_steps_, block.time)
                     : Report{Outcome::step_underflow, "the step no longer changes the time", -1});
      break;
    }
    const int top = lanes->draw(seeds(first), moves, block.update);
    const int order = lanes->order_for(top);
    const double unit = unit_for(h);
    lanes->grow(block.position, block.velocity, block.time, top, unit);
    lanes->sum(top, h, unit);

    const double *next_position = lanes->position(), *next_velocity = lanes->velocity();
    const auto lane = [&](const double* rows, int i) {
      Coordinates<double> of_lane(system_.particles, system_.dimension);
      for (int c = 0; c < system_.components; ++c)
        of_lane.data()[c] = system_.inverse_mass[c] == 0.0 ? 0.0 : rows[c * lanes_ + i];
      return of_lane;
    };
    for (int i = 0; i < active; ++i)
      if (moves[i] && !lanes->is_finite(i)) {
        Report report;
        all_finite(lane(next_position, i), lane(next_velocity, i), block.time, report);
        end(i, std::move(report));
      }
    block.begin = block.time;
    block.begin_position = block.position;
    block.begin_velocity = block.velocity;
    for (int c = 0; c < system_.components; ++c) {
      if (system_.inverse_mass[c] == 0.0) continue;
      for (int i = 0; i < lanes_; ++i) {
        if (!moves[i]) continue;
        block.position[c * lanes_ + i] = next_position[c * lanes_ + i];
        block.velocity[c * lanes_ + i] = next_velocity[c * lanes_ + i];
      }
    }
    block.time = h == end_ - block.time ? end_ : block.time + h;
    ++block.update;

    block.work.steps += moving;
    block.work.updates += static_cast<std::uint64_t>(moving) * moving_;
    block.work.coefficients += static_cast<std::uint64_t>(moving) * moving_ * (order - 1);
    block.work.element_coefficients += static_cast<std::uint64_t>(moving) * system_.elements * (order - 1);
    for (int i = 0; i < active; ++i)
      if (moves[i]) {
        block.work.degrees += lanes->degrees(i);
        block.orders += lanes->order_for(lanes->top(i)) - 1;
      }
  }
  if (block.time >= until) look(first, until, block, *lanes);
  pool_.give_back(std::move(lanes));
}

/// The states at a time of the last step, which is taken once more where it does not end there.
void MembersInLanes::look(std::size_t first, double time, Block& block, StoppedLanes& lanes) const {
  block.seen = time;
  block.seen_position = block.position;
  block.seen_velocity = block.velocity;
  if (time == block.time || block.update == 0) return;
  std::vector<char> moves(lanes_, 0);
  for (int i = 0; i < lanes_ && first + i < reports.size(); ++i)
    moves[i] = reports[first + i].outcome == Outcome::success;
  const int top = lanes.draw(seeds(first), moves, block.update - 1);
  const double unit = unit_for(block.time - block.begin);
  lanes.grow(block.begin_position, block.begin_velocity, block.begin, top, unit);
  lanes.sum(top, time - block.begin, unit);
  const double *position = lanes.position(), *velocity = lanes.velocity();
  for (int c = 0; c < system_.components; ++c) {
    if (system_.inverse_mass[c] == 0.0) continue;
    std::copy_n(position + c * lanes_, lanes_, block.seen_position.data() + c * lanes_);
    std::copy_n(velocity + c * lanes_, lanes_, block.seen_velocity.data() + c * lanes_);
  }
}

State<double> MembersInLanes::state(std::size_t i) const {
  const Block& block = blocks_[i / lanes_];
  const bool stopped = reports[i].outcome != Outcome::success;
  State<double> state{stopped ? stopped_[i] : block.seen,
                      Coordinates<double>(system_.particles, system_.dimension),
                      Coordinates<double>(system_.particles, system_.dimension)};
  for (int c = 0; c < system_.components; ++c) {
    const std::size_t at = c * lanes_ + i % lanes_;
    state.position.data()[c] = stopped ? block.position[at] : block.seen_position[at];
    state.velocity.data()[c] = stopped ? block.velocity[at] : block.seen_velocity[at];
  }
  return state;
}

}  // namespace

bool fits_lanes(const System<double>& system) {
  std::size_t elements = 0;
  for (const Elements<double>& of_a_law : system.elements()) elements += of_a_law.count();
  return elements <= most_elements;
}

std::unique_ptr<RandomEnsemble::Members> members_in_lanes(const System<double>& system,
                                                          const SeriesMethod& method, std::size_t count,
                                                          const RandomEnsemble::Start& start,
                                                          const RandomEnsemble::Options& options) {
  return std::make_unique<MembersInLanes>(system, method, count, start, options);
}

}  // namespace jetlag
