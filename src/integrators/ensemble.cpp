// SPDX-License-Identifier: MIT
#include "jetlag/integrators/ensemble.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string_view>

#if !defined(__x86_64__)
#define JETLAG_INSTRUCTION_SET_NAME plain
#endif
#include "integrators/ensemble_lanes.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/integrators/integrator.hpp"
#include "jetlag/motion/system_tape.hpp"

namespace jetlag {

#if defined(__x86_64__)
namespace sse2 {
extern const EnsembleLanes ensemble;
}
namespace avx2 {
extern const EnsembleLanes ensemble;
}
namespace avx512 {
extern const EnsembleLanes ensemble;
}
#endif

const EnsembleLanes& ensemble_lanes([[maybe_unused]] const char* instruction_set) {
#if defined(__x86_64__)
  if (std::string_view(instruction_set) == "avx512") return avx512::ensemble;
  if (std::string_view(instruction_set) == "avx2") return avx2::ensemble;
  return sse2::ensemble;  // also beside the scalar kernels
#else
  return plain::ensemble;
#endif
}

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

namespace {

/// All positions get a place where every order is kept: new orders are written there, nothing is copied.
std::vector<Place> keep_positions(Program& program, int components, int dimension) {
  std::vector<Place> series(components, Place{Place::Space::history, -1});
  const auto rename = [&](Place from, Place to) {
    const auto in = [&](Place& place) {
      if (place.space == from.space && place.slot == from.slot) place = to;
    };
    for (auto* instructions : {&program.preparation, &program.instructions})
      for (Instruction& instruction : *instructions)
        for (Place& place : instruction.operands) in(place);
    for (Place& place : program.outputs) in(place);
    for (auto& loaded : program.inputs) in(loaded.place);
  };
  for (std::size_t i = 0; i < program.inputs.size(); ++i) {
    const auto [place, input] = program.inputs[i];
    if (input.kind != Input::Kind::position) continue;
    Place& kept = series[input.participant * dimension + input.component];
    kept = place.space == Place::Space::history ? place : Place{Place::Space::history, program.histories++};
    if (place.space != Place::Space::history) rename(place, kept);
  }
  for (Place& place : series)
    if (place.slot < 0) place.slot = program.histories++;
  std::erase_if(program.inputs,
                [](const auto& loaded) { return loaded.input.kind == Input::Kind::position; });
  return series;
}

}  // namespace

Ensemble::Ensemble(const System<double>& system, int degree, const std::vector<State<double>>& states,
                   double max_step, Workers workers, const KernelTable<double>& table)
    : particles_(system.particles()),
      dimension_(system.dimension()),
      components_(particles_ * dimension_),
      degree_(degree),
      count_(states.size()),
      max_step_(max_step),
      workers_(std::move(workers)),
      table_(&table),
      program_(system_tape(system)),
      outcome_(count_, Outcome::success),
      steps_(count_, 0) {
  if (degree < 1) throw std::invalid_argument("Ensemble: degree must be >= 1, got " + std::to_string(degree));
  require_positive("Ensemble: max_step", max_step, true);
  for (const Elements<double>& elements : system.elements()) elements_ += elements.count();
  for (int i = 0; i < particles_; ++i)
    inverse_mass_.insert(inverse_mass_.end(), dimension_, system.fixed()[i] ? 0.0 : 1.0 / system.mass()[i]);
  series_ = keep_positions(program_, components_, dimension_);
  for (const auto& loaded : program_.inputs)
    reads_velocity_ = reads_velocity_ || loaded.input.kind == Input::Kind::velocity;

  const std::size_t lanes = table.lanes;
  position_.resize(blocks() * components_ * lanes);
  velocity_.resize(position_.size());
  time_.resize(blocks() * lanes);
  for (std::size_t e = 0; e < blocks() * lanes; ++e) {  // lanes beyond the last trajectory repeat it
    const State<double>& state = states[std::min(e, count_ - 1)];
    require_shape(state, particles_, dimension_);
    if (!std::isfinite(state.time))
      throw std::invalid_argument("Ensemble: the time of state " + std::to_string(std::min(e, count_ - 1)) +
                                  " must be finite");
    time_[e] = state.time;
    for (int c = 0; c < components_; ++c) {
      if (inverse_mass_[c] == 0.0 && state.velocity.data()[c] != 0.0)
        throw std::invalid_argument("Ensemble: particle " + std::to_string(c / dimension_) +
                                    " is fixed and must be at rest");
      const std::size_t at = (e / lanes * components_ + c) * lanes + e % lanes;
      position_[at] = state.position.data()[c];
      velocity_[at] = state.velocity.data()[c];
    }
  }
}

void Ensemble::advance_to(double until) {
  if (!std::isfinite(until)) throw std::invalid_argument("Ensemble: the time to advance to must be finite");
  const std::size_t tasks = std::min<std::size_t>(blocks(), workers_.threads());
  std::vector<std::unique_ptr<Workspace>> idle;
  for (std::size_t i = 0; i < tasks; ++i)
    idle.push_back(std::make_unique<Workspace>(program_, *table_, degree_, components_));
  std::mutex mutex;
  workers_.each(blocks(), [&](std::size_t block) {
    std::unique_ptr<Workspace> work;
    {
      const std::lock_guard lock(mutex);
      if (!idle.empty()) {
        work = std::move(idle.back());
        idle.pop_back();
      }
    }
    if (!work) work = std::make_unique<Workspace>(program_, *table_, degree_, components_);
    advance(block, until, *work);
    const std::lock_guard lock(mutex);
    idle.push_back(std::move(work));
  });
}

/// The series of the positions up to order degree + 1, from their orders 0 and 1.
void Ensemble::grow(const double* time, Workspace& work) const {
  Blocks<double>& blocks = work.blocks;
  const int lanes = table_->lanes, last = degree_ - 1;
  for (int k = 0; k <= last;) {
    const int orders = !reads_velocity_ && k < last ? 2 : 1;
    for (const auto& [place, input] : program_.inputs)
      for (int n = k; n < k + orders; ++n) {
        double* to = blocks.at(0, place, n);
        const std::size_t c = static_cast<std::size_t>(input.participant) * dimension_ + input.component;
        if (input.kind == Input::Kind::time) {
          for (int i = 0; i < lanes; ++i) to[i] = n == 0 ? time[i] : n == 1 ? 1.0 : 0.0;
        } else if (input.kind == Input::Kind::velocity) {
          work.lanes.scale(lanes, n + 1, blocks.at(0, series_[c], n + 1), to);
        } else {
          const double* plus = blocks.at(0, series_[c], n);
          const double* minus =
              blocks.at(0, series_[(1 - input.participant) * dimension_ + input.component], n);
          work.lanes.subtract(lanes, plus, minus, to);
        }
      }
    blocks.run(0, k, orders);
    for (int c = 0; c < components_; ++c) {
      if (inverse_mass_[c] == 0.0) continue;
      const Place output = program_.outputs[c];
      const bool constant = output.space == Place::Space::statics;
      double* to = blocks.at(0, series_[c], k + 2);
      if (orders == 2 && !constant) {
        const double of_this = inverse_mass_[c] / ((k + 1.0) * (k + 2.0)),
                     of_next = inverse_mass_[c] / ((k + 2.0) * (k + 3.0));
        work.lanes.scale_two(lanes, of_this, of_next, blocks.at(0, output, k), blocks.at(0, output, k + 1),
                             to);
        continue;
      }
      for (int n = k; n < k + orders; ++n, to += lanes)
        if (n > 0 && constant)
          std::fill_n(to, lanes, 0.0);
        else
          work.lanes.scale(lanes, inverse_mass_[c] / ((n + 1.0) * (n + 2.0)), blocks.at(0, output, n), to);
    }
    k += orders;
  }
}

/// The step of each lane: that of jorba_zou_step for the positions and for the velocities, as in JorbaZou. Where the norms
/// of a lane are normal numbers the conditions are solved for the logarithm of the step, in all those lanes at once.
void Ensemble::choose_steps(Workspace& work) const {
  const int lanes = table_->lanes, p = degree_;
  const double log_sigma = (-2.0 - 0.5 / std::max(1, p - 1)) / std::log(2.0);
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
    for (int c = 0; c < components_; ++c)
      if (inverse_mass_[c] != 0.0 || (!of_velocity && k == 0))
        work.lanes.largest(lanes, work.blocks.at(0, series_[c], k + of_velocity), norm(of_velocity, k),
                           not_finite.data());
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
         *next_velocity = next_position + static_cast<std::size_t>(components_) * lanes;
  const auto goes_on = [&](int i) { return outcome_[first + i] == Outcome::success && time[i] < until; };
  std::vector<char> moves(lanes, 0);
  for (;;) {
    bool any = false;
    for (int i = 0; i < active; ++i) any |= moves[i] = goes_on(i);
    if (!any) return;
    for (int c = 0; c < components_; ++c) {
      std::copy_n(position + c * lanes, lanes, work.blocks.at(0, series_[c], 0));
      std::copy_n(velocity + c * lanes, lanes, work.blocks.at(0, series_[c], 1));
    }
    grow(time, work);
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
    for (int c = 0; c < components_; ++c) {  // v_k = (k+1) x_{k+1}
      if (inverse_mass_[c] == 0.0) continue;
      const double* x = work.blocks.at(0, series_[c], 0);
      work.lanes.horner(lanes, degree_, x, work.step.data(), next_position + c * lanes,
                        next_velocity + c * lanes);
    }
    std::ranges::fill(work.not_finite, 0.0);
    std::ranges::fill(work.best, 0.0);
    for (int c = 0; c < components_; ++c)
      if (inverse_mass_[c] != 0.0)
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
    for (int c = 0; c < components_; ++c) {
      if (inverse_mass_[c] == 0.0) continue;
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
  State<double> state{time_[i], Coordinates<double>(particles_, dimension_),
                      Coordinates<double>(particles_, dimension_)};
  for (int c = 0; c < components_; ++c) {
    const std::size_t at = (i / lanes * components_ + c) * lanes + i % lanes;
    state.position.data()[c] = position_[at];
    state.velocity.data()[c] = velocity_[at];
  }
  return state;
}

std::uint64_t Ensemble::steps() const {
  return std::accumulate(steps_.begin(), steps_.end(), std::uint64_t{0});
}

}  // namespace jetlag
