// SPDX-License-Identifier: MIT
// Members in lanes: the whole system is one tape, a member an element of it. All members have one step and one time.
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/pool.hpp"
#include "ensembles/random_ensemble.hpp"
#include "ensembles/system_lanes.hpp"
#include "jetlag/control/fixed_step.hpp"

namespace jetlag {

namespace {

/// Elements of a system up to which lanes are faster for sure. Measured, degrees 3 to 6 and 3 to 12, springs and drag:
/// a step of 8 elements takes 0.19 and 0.28 us a member in lanes, 0.78 and 0.82 us one by one; one of 100 elements 2.3
/// and 3.4 in lanes, 3.1 and 3.1 one by one; one of 560 elements 19 and 30 in lanes, 14 and 15 one by one.
constexpr std::size_t most_elements = 100;

/// The power of two next to a step, as unit of time: coefficient n of the series is then of the size of the term, x_n
/// h^n, and neither over- nor underflows where the sum does not, however fast or slow the motion. Its square is a
/// double.
double unit_for(double step) {
  return std::ldexp(1.0, std::clamp(static_cast<int>(std::lround(std::log2(step))), -500, 500));
}

class InLanes final : public RandomEnsemble::Members {
 public:
  InLanes(const System<double>& system, const SeriesMethod& method, std::size_t count,
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
  struct Workspace {
    Workspace(const InLanes& of)
        : series(of.system_.program, of.lanes_, {}, *of.table_),
          weights(static_cast<std::size_t>(of.draws_) * of.terms_ * of.lanes_, 0.0),
          next(2 * static_cast<std::size_t>(of.system_.components) * of.lanes_),
          time(of.lanes_),
          not_finite(of.lanes_),
          largest(of.lanes_),
          degrees(of.lanes_),
          tops(of.lanes_) {
      series.reserve(of.law_.max_degree() + 2);
    }
    Blocks<double> series;
    AlignedVector<double> weights;  // [draw][term][lane]
    AlignedVector<double> next, time, not_finite, largest;
    std::vector<std::uint64_t> degrees;  // sum over the moving particles
    std::vector<int> tops;               // the largest of them
  };

  int draw(std::size_t first, const std::vector<char>& moves, std::uint64_t update, Workspace& work) const;
  void grow(const AlignedVector<double>& position, const AlignedVector<double>& velocity, double time,
            int top, double unit, Workspace& work) const;
  void sum(int top, double h, double unit, Workspace& work) const;
  void look(std::size_t first, double time, Block& block, Workspace& work) const;
  int order_needed(int top) const {
    return options_.velocity == VelocitySeries::own_series ? top + 1 : std::max(top, 1);
  }

  SystemLanes system_;
  TruncationLaw law_;
  RandomTaylor::Options options_;
  double step_;
  const KernelTable<double>* table_;
  const EnsembleLanes* of_;
  int lanes_, draws_, terms_;  // draws_: 1, or one for each particle; terms_: one more than the law has
  int moving_ = 0;
  std::uint64_t max_steps_;
  double end_;
  std::vector<Draws> draws_of_;  // of each member
  std::vector<double> stopped_;  // the time of each member that has failed
  std::vector<Block> blocks_;
  Pool<Workspace> pool_;
};

InLanes::InLanes(const System<double>& system, const SeriesMethod& method, std::size_t count,
                 const RandomEnsemble::Start& start, const RandomEnsemble::Options& options)
    : Members(count),
      system_(system),
      law_(known_beforehand(method.law)),
      options_(method.options),
      step_(dynamic_cast<const FixedStep&>(*method.control).step()),
      table_(&kernels<double>()),  // of one width, whatever the number of members: the same bits
      of_(&ensemble_lanes(table_->instruction_set)),
      lanes_(table_->lanes),
      terms_(law_.max_degree() + 2),
      moving_(moving_particles(system)),
      max_steps_(options.max_steps),
      end_(options.end) {
  if (law_.is_fixed()) {
    options_.shared_draw = true;
    options_.draws = Draw::independent;
  }
  draws_ = options_.shared_draw ? 1 : system_.particles;
  draws_of_.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    draws_of_.emplace_back(options_.draws, &law_, member_seed(options_.seed, i),
                           static_cast<std::uint32_t>(draws_));
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

/// The weights of this step, 1 / P(K >= n) for n <= K and 0 beyond, K as RandomTaylor draws it. Returns the largest K of
/// the members that move.
int InLanes::draw(std::size_t first, const std::vector<char>& moves, std::uint64_t update,
                  Workspace& work) const {
  std::ranges::fill(work.tops, law_.min_degree());
  std::ranges::fill(work.degrees, 0);
  for (int d = 0; d < draws_; ++d) {
    const bool fixed = !options_.shared_draw && system_.inverse_mass[d * system_.dimension] == 0.0;
    if (fixed) continue;
    const auto particle = options_.shared_draw ? shared_by_all : static_cast<std::uint32_t>(d);
    double* weights = work.weights.data() + static_cast<std::size_t>(d) * terms_ * lanes_;
    for (int lane = 0; lane < lanes_; ++lane) {
      int degree = law_.min_degree();
      if (law_.is_fixed())
        degree = law_.max_degree();
      else if (moves[lane])
        degree = draws_of_[first + lane].degree(law_, particle, update);
      if (moves[lane]) {
        work.tops[lane] = std::max(work.tops[lane], degree);
        work.degrees[lane] += options_.shared_draw ? static_cast<std::uint64_t>(degree) * moving_ : degree;
      }
      for (int n = 0; n <= law_.max_degree(); ++n)
        weights[n * lanes_ + lane] = n <= degree ? law_.weight(n, degree) : 0.0;
    }
  }
  return *std::ranges::max_element(work.tops);
}

/// The series from a state, for degrees up to `top`; coefficient n comes times unit^n.
void InLanes::grow(const AlignedVector<double>& position, const AlignedVector<double>& velocity, double time,
                   int top, double unit, Workspace& work) const {
  for (int c = 0; c < system_.components; ++c) {
    double* x = work.series.at(0, system_.series[c], 0);
    std::copy_n(position.data() + c * lanes_, lanes_, x);
    of_->scale(lanes_, unit, velocity.data() + c * lanes_, x + lanes_);
  }
  std::ranges::fill(work.time, time);
  system_.grow(work.series, *of_, work.time.data(), order_needed(top), unit);
}

/// Positions and velocities after h; sums over powers of h / unit.
void InLanes::sum(int top, double h, double unit, Workspace& work) const {
  const bool derivative = options_.velocity == VelocitySeries::derivative;
  const double s = h / unit;
  double* position = work.next.data();
  double* velocity = position + static_cast<std::size_t>(system_.components) * lanes_;
  for (int c = 0; c < system_.components; ++c, position += lanes_, velocity += lanes_) {
    if (system_.inverse_mass[c] == 0.0) continue;
    const int draw = options_.shared_draw ? 0 : c / system_.dimension;
    const double* weights = work.weights.data() + static_cast<std::size_t>(draw) * terms_ * lanes_;
    const double* x = work.series.at(0, system_.series[c], 0);
    of_->weighted(lanes_, false, top, x, weights, s, position);
    // With `derivative`, coefficient n of the velocity carries the weight of coefficient n + 1 of the position.
    of_->weighted(lanes_, true, derivative ? top - 1 : top, x, derivative ? weights + lanes_ : weights, s,
                  velocity);
    of_->multiply(lanes_, 1 / unit, velocity);
    for (const double* next : {position, velocity})
      of_->largest(lanes_, next, work.largest.data(), work.not_finite.data());
  }
}

void InLanes::advance(std::size_t number, double until, const std::function<bool()>& go_on) {
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
  auto work = pool_.lend([&] { return std::make_unique<Workspace>(*this); });
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
    const int top = draw(first, moves, block.update, *work);
    const int order = order_needed(top);
    const double unit = unit_for(h);
    grow(block.position, block.velocity, block.time, top, unit, *work);
    std::ranges::fill(work->not_finite, 0.0);
    sum(top, h, unit, *work);

    const double* next_position = work->next.data();
    const double* next_velocity = next_position + static_cast<std::size_t>(system_.components) * lanes_;
    const auto lane = [&](const double* rows, int i) {
      Coordinates<double> of_lane(system_.particles, system_.dimension);
      for (int c = 0; c < system_.components; ++c)
        of_lane.data()[c] = system_.inverse_mass[c] == 0.0 ? 0.0 : rows[c * lanes_ + i];
      return of_lane;
    };
    for (int i = 0; i < active; ++i)
      if (moves[i] && std::isnan(work->not_finite[i])) {
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
        block.work.degrees += work->degrees[i];
        block.orders += order_needed(work->tops[i]) - 1;
      }
  }
  if (block.time >= until) look(first, until, block, *work);
  pool_.give_back(std::move(work));
}

/// The states at a time of the last step, which is taken once more where it does not end there.
void InLanes::look(std::size_t first, double time, Block& block, Workspace& work) const {
  block.seen = time;
  block.seen_position = block.position;
  block.seen_velocity = block.velocity;
  if (time == block.time || block.update == 0) return;
  std::vector<char> moves(lanes_, 0);
  for (int i = 0; i < lanes_ && first + i < reports.size(); ++i)
    moves[i] = reports[first + i].outcome == Outcome::success;
  const int top = draw(first, moves, block.update - 1, work);
  const double unit = unit_for(block.time - block.begin);
  grow(block.begin_position, block.begin_velocity, block.begin, top, unit, work);
  sum(top, time - block.begin, unit, work);
  const double* position = work.next.data();
  const double* velocity = position + block.position.size();
  for (int c = 0; c < system_.components; ++c) {
    if (system_.inverse_mass[c] == 0.0) continue;
    std::copy_n(position + c * lanes_, lanes_, block.seen_position.data() + c * lanes_);
    std::copy_n(velocity + c * lanes_, lanes_, block.seen_velocity.data() + c * lanes_);
  }
}

State<double> InLanes::state(std::size_t i) const {
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
  return std::make_unique<InLanes>(system, method, count, start, options);
}

}  // namespace jetlag
