// SPDX-License-Identifier: MIT
#include "jetlag/ensembles/ensemble.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "base/pool.hpp"
#include "ensembles/system_lanes.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/integrators/integrator.hpp"

namespace jetlag {

/// The series of one block of trajectories, and what its step needs besides. Every step starts from the state anew, so
/// that any block can use any workspace.
struct Ensemble::Workspace {
  Workspace(const Program& program, const KernelTable<double>& table, int degree, int components)
      : blocks(program, table.lanes, {}, table),
        lanes(ensemble_lanes(table.instruction_set)),
        norms(2 * static_cast<std::size_t>(degree + 1) * table.lanes),
        logs(norms.size()),
        next(2 * static_cast<std::size_t>(components) * table.lanes),
        step(table.lanes),
        not_finite(table.lanes),
        best(table.lanes),
        log_step(table.lanes),
        least(table.lanes),
        most(table.lanes),
        regular(table.lanes) {
    blocks.reserve(degree + 2);
  }

  Blocks<double> blocks;
  const EnsembleLanes& lanes;
  AlignedVector<double> norms, logs;  // [kind][order][lane], [order][lane]
  AlignedVector<double> next;         // the state after the step
  AlignedVector<double> step, not_finite, best, log_step, least, most;
  std::vector<char> regular;  // whether the norms of a lane are normal numbers
};

struct Ensemble::Workspaces : Pool<Workspace> {};

Ensemble::Ensemble(const System<double>& system, int degree, const std::vector<State<double>>& states,
                   double max_step, Workers workers, const KernelTable<double>& table)
    : system_(std::make_shared<SystemLanes>(system)),
      degree_(degree),
      count_(states.size()),
      max_step_(max_step),
      workers_(std::move(workers)),
      workspaces_(std::make_shared<Workspaces>()),
      table_(&table),
      outcome_(count_, Outcome::success),
      steps_(count_, 0) {
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

/// The step of each lane: that of jorba_zou_step for the positions and for the velocities, as in JorbaZou. Where the norms
/// of a lane are normal numbers the conditions are solved for the logarithm of the step, in all those lanes at once.
void Ensemble::choose_steps(Workspace& work) const {
  const int lanes = table_->lanes, p = degree_;
  const double log_sigma = log_safety_of_jorba_zou(p) / std::log(2.0);
  constexpr double least = 0x1p-1022, most = 0x1p1000;
  std::ranges::fill(work.log_step, 2000.0);  // infinite
  std::ranges::fill(work.not_finite, 0.0);
  std::ranges::fill(work.regular, 1);
  std::ranges::fill(work.norms, 0.0);
  const auto low = [](bool of_velocity) { return of_velocity ? 1 : 2; };
  const auto read = [&](bool of_velocity, int k) { return k <= low(of_velocity) || k >= p - 1; };
  const auto norm = [&](bool of_velocity, int k) {
    return work.norms.data() + (of_velocity * (p + 1) + k) * lanes;
  };
  const auto log = [&](int k) { return work.logs.data() + k * lanes; };
  const auto measure = [&](bool of_velocity, int k, AlignedVector<double>& not_finite) {
    for (int c = 0; c < system_->components; ++c)
      if (system_->inverse_mass[c] != 0.0 || (!of_velocity && k == 0))
        work.lanes.largest(lanes, work.blocks.at(0, system_->series[c], k + of_velocity),
                           norm(of_velocity, k), not_finite.data());
    if (of_velocity) work.lanes.multiply(lanes, k + 1, norm(of_velocity, k));
  };
  for (const bool of_velocity : {false, true}) {
    std::ranges::fill(work.least, most);
    std::ranges::fill(work.most, 0.0);
    for (int k = 0; k <= p; ++k)
      if (read(of_velocity, k)) {
        measure(of_velocity, k, work.not_finite);
        work.lanes.extend(lanes, norm(of_velocity, k), work.least.data(), work.most.data());
        work.lanes.log2(lanes, norm(of_velocity, k), log(k));
      }
    for (int i = 0; i < lanes; ++i)
      if (!(work.least[i] >= least && work.most[i] < most)) work.regular[i] = 0;
    for (int q = p; q >= std::max(1, p - 1); --q) {
      std::ranges::fill(work.best, -1e9);
      for (int n = 0; n < q; ++n)
        if (read(of_velocity, n))
          work.lanes.bound(lanes, log(n), log(q), q * log_sigma, 1.0 / (q - n), work.best.data());
      work.lanes.smaller(lanes, work.best.data(), work.log_step.data());
    }
  }
  bool all_regular = true;
  for (int i = 0; i < lanes; ++i) {
    all_regular &= work.regular[i] != 0;
    work.step[i] = work.regular[i] ? std::min(max_step_, std::exp2(work.log_step[i])) : max_step_;
  }
  if (all_regular) return;
  std::vector<double> norms(p + 1);
  for (const bool of_velocity : {false, true}) {
    for (int k = low(of_velocity) + 1; k < p - 1; ++k) measure(of_velocity, k, work.best);
    for (int i = 0; i < lanes; ++i) {
      if (work.regular[i]) continue;
      bool all_zero = true;
      for (int k = 0; k <= std::min(low(of_velocity), p - 1); ++k) all_zero &= norm(of_velocity, k)[i] == 0.0;
      for (int k = 0; k <= p; ++k)
        norms[k] = read(of_velocity, k) || all_zero ? norm(of_velocity, k)[i] : 0.0;
      work.step[i] = jorba_zou_step(norms, work.step[i]);
    }
  }
}

void Ensemble::advance(std::size_t block, double until, Workspace& work) {
  const int lanes = table_->lanes;
  const std::size_t first = block * lanes;
  const int active = static_cast<int>(std::min<std::size_t>(lanes, count_ - first));
  double *position = rows(position_, block), *velocity = rows(velocity_, block), *time = &time_[first];
  double *next_position = work.next.data(),
         *next_velocity = next_position + static_cast<std::size_t>(system_->components) * lanes;
  const auto goes_on = [&](int i) { return outcome_[first + i] == Outcome::success && time[i] < until; };
  std::vector<char> moves(lanes, 0);
  for (;;) {
    bool any = false;
    for (int i = 0; i < active; ++i) any |= moves[i] = goes_on(i);
    if (!any) return;
    for (int c = 0; c < system_->components; ++c) {
      std::copy_n(position + c * lanes, lanes, work.blocks.at(0, system_->series[c], 0));
      std::copy_n(velocity + c * lanes, lanes, work.blocks.at(0, system_->series[c], 1));
    }
    system_->grow(work.blocks, work.lanes, time, degree_ + 1);
    choose_steps(work);
    for (int i = 0; i < active; ++i) {
      if (!moves[i]) continue;
      const double h = cropped(work.step[i], until - time[i]);
      if (std::isnan(work.not_finite[i]))
        outcome_[first + i] = Outcome::non_finite;
      else if (!advances(time[i], h))
        outcome_[first + i] = Outcome::step_underflow;
      work.step[i] = h;
    }
    for (int c = 0; c < system_->components; ++c) {  // v_k = (k+1) x_{k+1}
      if (system_->inverse_mass[c] == 0.0) continue;
      const double* x = work.blocks.at(0, system_->series[c], 0);
      work.lanes.horner(lanes, degree_, x, work.step.data(), next_position + c * lanes,
                        next_velocity + c * lanes);
    }
    std::ranges::fill(work.not_finite, 0.0);
    std::ranges::fill(work.best, 0.0);
    for (int c = 0; c < system_->components; ++c)
      if (system_->inverse_mass[c] != 0.0)
        for (const double* next : {next_position, next_velocity})
          work.lanes.largest(lanes, next + c * lanes, work.best.data(), work.not_finite.data());
    bool all = active == lanes;
    for (int i = 0; i < active; ++i) {
      if (moves[i] && std::isnan(work.not_finite[i])) outcome_[first + i] = Outcome::non_finite;
      moves[i] = moves[i] && outcome_[first + i] == Outcome::success;
      all &= moves[i] != 0;
      if (!moves[i]) continue;
      time[i] = work.step[i] == until - time[i] ? until : time[i] + work.step[i];
      ++steps_[first + i];
    }
    for (int c = 0; c < system_->components; ++c) {
      if (system_->inverse_mass[c] == 0.0) continue;
      for (int i = 0; i < lanes; ++i) {
        if (!all && !moves[i]) continue;
        position[c * lanes + i] = next_position[c * lanes + i];
        velocity[c * lanes + i] = next_velocity[c * lanes + i];
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
