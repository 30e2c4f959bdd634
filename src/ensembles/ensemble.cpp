// SPDX-License-Identifier: MIT
#include "jetlag/ensembles/ensemble.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "base/pool.hpp"
#include "ensembles/system_lanes.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/integrators/integrator.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/series/calculus/row_sums.hpp"

namespace jetlag {

/// The series of one block of trajectories, and what its step needs besides. Every step starts from the state anew, so
/// that any block can use any workspace.
struct Ensemble::Workspace {
  Workspace(const Program& program, const KernelTable<double>& table, int degree, int components)
      : blocks(program, table.lanes, {}, table),
        lanes(ensemble_lanes(table.instruction_set)),
        sizes(static_cast<std::size_t>(degree + 2) * table.lanes),
        logs(sizes.size()),
        next(2 * static_cast<std::size_t>(components) * table.lanes),
        step(table.lanes),
        not_finite(table.lanes),
        best(table.lanes),
        log_step(table.lanes),
        least(table.lanes),
        most(table.lanes),
        regular(table.lanes),
        before(2 * static_cast<std::size_t>(components) * table.lanes),
        time_before(table.lanes),
        leads_to(static_cast<std::size_t>(components) * table.lanes),
        allowed(table.lanes),
        departure(table.lanes),
        moves(table.lanes, 0),
        unseen(table.lanes, 0) {
    blocks.reserve(degree + 2);
  }

  Blocks<double> blocks;
  const EnsembleLanes& lanes;
  AlignedVector<double> sizes, logs;  // [order][lane]
  AlignedVector<double> next;         // the state after the step
  AlignedVector<double> step, not_finite, best, log_step, least, most;
  std::vector<char> regular;                  // whether the sizes of a lane are normal numbers
  AlignedVector<double> before, time_before;  // the state before the step
  AlignedVector<double> leads_to;             // x'' to which the series of the step leads
  AlignedVector<double> allowed,
      departure;             // how far it may depart from the accelerations there, how far it does [m/s^2]
  std::vector<char> moves;   // whether a lane takes a step with the others
  std::vector<char> unseen;  // whether that is not known yet
  std::unique_ptr<RandomTaylor> alone;  // for steps that a lane does not take with the others
};

struct Ensemble::Workspaces : Pool<Workspace> {};

Ensemble::Ensemble(const System<double>& system, int degree, const std::vector<State<double>>& states,
                   double max_step, Workers workers, const KernelTable<double>& table)
    : system_(std::make_shared<SystemLanes>(system)),
      alone_(std::make_shared<System<double>>(system)),
      degree_(degree),
      count_(states.size()),
      max_step_(max_step),
      workers_(std::move(workers)),
      workspaces_(std::make_shared<Workspaces>()),
      table_(&table),
      outcome_(count_, Outcome::success),
      steps_(count_, 0),
      lone_steps_(count_, 0),
      changes_(count_) {
  if (degree < 1) throw std::invalid_argument("Ensemble: degree must be >= 1, got " + std::to_string(degree));
  require_positive("Ensemble: max_step", max_step, true);
  for (const Elements<double>& elements : system.elements())
    if (elements.law.kink != nullptr && !elements.law.has_point_kinks() && elements.count() > 0)
      throw std::invalid_argument("Ensemble: the force of " + elements.law.name +
                                  " has a kink, at which the steps of an ensemble do not end; run each "
                                  "trajectory by itself (Lockstep)");

  const std::size_t lanes = table_->lanes;
  position_.resize(blocks() * system_->components * lanes);
  velocity_.resize(position_.size());
  time_.resize(blocks() * lanes);
  for (std::size_t e = 0; e < blocks() * lanes; ++e) {  // lanes beyond the last trajectory repeat it
    const State<double>& state = states[std::min(e, count_ - 1)];
    require_shape(state, system_->particles, system_->dimension);
    if (!std::isfinite(state.time))
      throw std::invalid_argument("Ensemble: the time of state " + std::to_string(std::min(e, count_ - 1)) +
                                  " must be finite");
    time_[e] = state.time;
    for (int c = 0; c < system_->components; ++c) {
      if (system_->inverse_mass[c] == 0.0 && state.velocity.data()[c] != 0.0)
        throw std::invalid_argument("Ensemble: particle " + std::to_string(c / system_->dimension) +
                                    " is fixed and must be at rest");
      const std::size_t at = (e / lanes * system_->components + c) * lanes + e % lanes;
      position_[at] = state.position.data()[c];
      velocity_[at] = state.velocity.data()[c];
    }
  }
}

void Ensemble::advance_to(double until) {
  if (!std::isfinite(until)) throw std::invalid_argument("Ensemble: the time to advance to must be finite");
  workers_.each(blocks(), [&](std::size_t block) {
    auto work = workspaces_->lend(
        [&] { return std::make_unique<Workspace>(system_->program, *table_, degree_, system_->components); });
    advance(block, until, *work);
    workspaces_->give_back(std::move(work));
  });
}

/// The step of each lane: that of JorbaZou for its motion. Where the sizes of a lane are normal numbers the conditions are solved
/// for the logarithm of the step, in all those lanes at once.
void Ensemble::choose_steps(Workspace& work) const {
  const int lanes = table_->lanes, p = degree_;
  constexpr double least = 0x1p-1022, most = 0x1p1000;
  std::ranges::fill(work.log_step, 2000.0);  // infinite
  std::ranges::fill(work.not_finite, 0.0);
  std::ranges::fill(work.least, most);
  std::ranges::fill(work.most, 0.0);
  const auto is_read = [&](int k) { return k <= 2 || k >= p; };
  const auto size = [&](int k) { return work.sizes.data() + k * lanes; };
  const auto log = [&](int k) { return work.logs.data() + k * lanes; };
  const auto measure = [&](int k, AlignedVector<double>& not_finite) {
    std::fill_n(size(k), lanes, 0.0);
    for (int c = 0; c < system_->components; ++c)
      if (system_->inverse_mass[c] != 0.0 || k == 0)
        work.lanes.largest(lanes, work.blocks.at(0, system_->series[c], k), size(k), not_finite.data());
    if (k > 1) work.lanes.multiply(lanes, k, size(k));
  };
  for (int k = 0; k <= p + 1; ++k) {
    if (!is_read(k)) continue;
    measure(k, work.not_finite);
    work.lanes.extend(lanes, size(k), work.least.data(), work.most.data());
    work.lanes.log2(lanes, size(k), log(k));
  }
  const double log_sigma = log_safety_of_jorba_zou(p) * std::numbers::log2e;
  for (const int q : {p, p + 1})
    for (const bool of_velocities : {false, true}) {
      std::ranges::fill(work.best, -1e9);
      for (int n = of_velocities; n < q; ++n)
        if (is_read(n))
          work.lanes.bound(lanes, log(n), log(q),
                           (q - 1) * log_sigma + of_velocities * log2_share_of_velocities(p), 1.0 / (q - n),
                           work.best.data());
      work.lanes.smaller(lanes, work.best.data(), work.log_step.data());
    }
  bool all_regular = true;
  for (int i = 0; i < lanes; ++i) {
    work.regular[i] = p > 1 && work.least[i] >= least && work.most[i] < most;
    all_regular &= work.regular[i] != 0;
    work.step[i] = work.regular[i] ? std::min(max_step_, std::exp2(work.log_step[i])) : max_step_;
  }
  if (all_regular) return;
  for (int k = 3; k < p; ++k) measure(k, work.best);
  for (int i = 0; i < lanes; ++i)
    if (!work.regular[i]) work.step[i] = jorba_zou_step_of(p, [&](int k) { return size(k)[i]; }, max_step_);
}

void Ensemble::load(std::size_t block, Workspace& work) const {
  const std::size_t lanes = table_->lanes, first = block * system_->components * lanes;
  for (int c = 0; c < system_->components; ++c) {
    double* x = work.blocks.at(0, system_->series[c], 0);
    std::copy_n(&position_[first + c * lanes], lanes, x);
    std::copy_n(&velocity_[first + c * lanes], lanes, work.blocks.at(0, system_->series[c], 1));
  }
}

/// A step of one trajectory, from its state.
void Ensemble::step_alone(std::size_t block, int lane, double until, Workspace& work) {
  const std::size_t i = block * table_->lanes + lane;
  if (!work.alone)
    work.alone = std::make_unique<RandomTaylor>(
        *alone_, fixed_degree(degree_), std::make_unique<JorbaZou>(max_step_), RandomTaylor::Options{});
  RandomTaylor::Member member;
  member.control = std::make_unique<JorbaZou>(max_step_);
  member.changes = changes_[i];
  State<double> now = state(i);
  Report report;
  const double limit = until - now.time;
  work.alone->exchange(member);
  const double h = work.alone->step(now, limit, report);
  work.alone->exchange(member);
  changes_[i] = member.changes;
  outcome_[i] = report.outcome;
  if (report.outcome != Outcome::success) return;
  time_[i] = h == limit ? until : now.time + h;
  ++steps_[i];
  ++lone_steps_[i];
  for (int c = 0; c < system_->components; ++c) {
    const std::size_t at = (block * system_->components + c) * table_->lanes + lane;
    position_[at] = now.position.data()[c];
    velocity_[at] = now.velocity.data()[c];
  }
}

/// Whether all forces at the ends of steps are those to which their series lead; trajectories for which they are not go back and
/// take the step by themselves.
bool Ensemble::check_ends(std::size_t block, double until, Workspace& work) {
  const int lanes = table_->lanes;
  std::ranges::fill(work.departure, 0.0);
  std::ranges::fill(work.not_finite, 0.0);
  for (int c = 0; c < system_->components; ++c)
    if (system_->inverse_mass[c] != 0.0)
      work.lanes.depart(lanes, work.blocks.at(0, system_->series[c], 2), &work.leads_to[c * lanes],
                        work.departure.data(), work.not_finite.data());
  bool all = true;
  for (int lane = 0; lane < lanes; ++lane) {
    if (!work.unseen[lane]) continue;
    work.unseen[lane] = 0;
    if (work.departure[lane] <= work.allowed[lane] && !std::isnan(work.not_finite[lane])) continue;
    all = false;
    const std::size_t i = block * lanes + lane;
    time_[i] = work.time_before[lane];
    --steps_[i];
    for (int c = 0; c < system_->components; ++c) {
      const std::size_t at = (block * system_->components + c) * lanes + lane;
      position_[at] = work.before[c * lanes + lane];
      velocity_[at] = work.before[(system_->components + c) * lanes + lane];
    }
    step_alone(block, lane, until, work);
  }
  return all;
}

/// Trajectories that are to move and for which a choice may change in their step take it by themselves.
void Ensemble::find_choices(std::size_t block, double until, Workspace& work) {
  const int lanes = table_->lanes;
  for (const auto& condition : system_->program.conditions) {
    const double* c = work.blocks.at(0, condition.place, 0);
    for (int lane = 0; lane < lanes; ++lane) {
      if (!work.moves[lane] || detail::outweighs_rest(c + lane, lanes, 1, degree_ - 1, work.step[lane]))
        continue;
      work.moves[lane] = 0;
      step_alone(block, lane, until, work);
    }
  }
}

void Ensemble::advance(std::size_t block, double until, Workspace& work) {
  const int lanes = table_->lanes, top = degree_ + 1, seen = std::min(3, top);
  const std::size_t first = block * lanes, components = system_->components;
  const int active = static_cast<int>(std::min<std::size_t>(lanes, count_ - first));
  double *position = rows(position_, block), *velocity = rows(velocity_, block), *time = &time_[first];
  double *next_position = work.next.data(), *next_velocity = next_position + components * lanes;
  const double of_degree = 16 * degree_ * std::exp(-2.0 * (degree_ - 1));
  constexpr double rounding = 0x1p16 * std::numeric_limits<double>::epsilon();
  std::ranges::fill(work.unseen, 0);
  for (;;) {
    bool any = false, any_unseen = false;
    for (int i = 0; i < active; ++i) {
      any |= work.moves[i] = outcome_[first + i] == Outcome::success && time[i] < until;
      any_unseen |= work.unseen[i] != 0;
    }
    if (!any && !any_unseen) return;
    load(block, work);
    system_->grow(work.blocks, work.lanes, time, seen);
    if (any_unseen && !check_ends(block, until, work)) continue;
    if (!any) return;
    system_->grow(work.blocks, work.lanes, time, top, 1, seen);
    choose_steps(work);
    for (int i = 0; i < active; ++i) {
      if (!work.moves[i]) continue;
      const double h = cropped(work.step[i], until - time[i]);
      work.step[i] = h;
      if (!std::isnan(work.not_finite[i]) && advances(time[i], h)) continue;
      work.moves[i] = 0;
      step_alone(block, i, until, work);
    }
    find_choices(block, until, work);
    for (std::size_t c = 0; c < components; ++c) {  // v_k = (k+1) x_{k+1}
      if (system_->inverse_mass[c] == 0.0) continue;
      const double* x = work.blocks.at(0, system_->series[c], 0);
      work.lanes.horner(lanes, degree_, x, work.step.data(), next_position + c * lanes,
                        next_velocity + c * lanes, &work.leads_to[c * lanes]);
    }
    std::ranges::fill(work.not_finite, 0.0);
    std::ranges::fill(work.best, 0.0);
    for (std::size_t c = 0; c < components; ++c)
      if (system_->inverse_mass[c] != 0.0)
        for (const double* next : {next_position, next_velocity})
          work.lanes.largest(lanes, next + c * lanes, work.best.data(), work.not_finite.data());
    bool all = active == lanes;
    for (int i = 0; i < active; ++i) {
      if (work.moves[i] && std::isnan(work.not_finite[i])) {
        work.moves[i] = 0;
        step_alone(block, i, until, work);
      }
      all &= work.moves[i] != 0;
      if (!work.moves[i]) continue;
      const double h = work.step[i];
      work.time_before[i] = time[i];
      time[i] = h == until - time[i] ? until : time[i] + h;
      ++steps_[first + i];
      changes_[first + i].take_none();
      work.unseen[i] = 1;
      const auto size = [&](int k) { return work.sizes[k * lanes + i]; };
      const double motion = std::max(size(1) / h, size(2));  // |v| / h, |a|
      work.allowed[i] = rounding * std::max(size(0) / (h * h), motion) + of_degree * motion;
    }
    for (std::size_t c = 0; c < components; ++c) {
      if (system_->inverse_mass[c] == 0.0) continue;
      for (int i = 0; i < lanes; ++i) {
        if (!all && !work.moves[i]) continue;
        const std::size_t at = c * lanes + i;
        work.before[at] = position[at];
        work.before[components * lanes + at] = velocity[at];
        position[at] = next_position[at];
        velocity[at] = next_velocity[at];
      }
    }
  }
}

State<double> Ensemble::state(std::size_t i) const {
  if (i >= count_)
    throw std::invalid_argument("Ensemble: trajectory " + std::to_string(i) + " does not exist, there are " +
                                std::to_string(count_));
  const std::size_t lanes = table_->lanes;
  State<double> state{time_[i], Coordinates<double>(system_->particles, system_->dimension),
                      Coordinates<double>(system_->particles, system_->dimension)};
  for (int c = 0; c < system_->components; ++c) {
    const std::size_t at = (i / lanes * system_->components + c) * lanes + i % lanes;
    state.position.data()[c] = position_[at];
    state.velocity.data()[c] = velocity_[at];
  }
  return state;
}

std::size_t Ensemble::blocks() const { return (count_ + table_->lanes - 1) / table_->lanes; }

double* Ensemble::rows(AlignedVector<double>& of, std::size_t block) const {
  return of.data() + block * system_->components * table_->lanes;
}

std::uint64_t Ensemble::element_coefficients() const { return steps() * system_->elements * degree_; }

std::uint64_t Ensemble::steps() const {
  return std::accumulate(steps_.begin(), steps_.end(), std::uint64_t{0});
}

}  // namespace jetlag
