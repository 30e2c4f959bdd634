// SPDX-License-Identifier: MIT
#pragma once
// Asynchronous variational integrator: every element has a clock of its own and pushes its particles when that rings.
//
//     element 0   |-------|-------|-------|-------|-------|      an impulse -h_K grad V_K at each bar
//     element 1   |---|---|---|---|---|---|---|---|---|---|
//     element 2   |------------|------------|------------|       in between, particles move on straight lines
//
// Source: A. Lew, J. Marsden, M. Ortiz, M. West, Asynchronous variational integrators, Arch. Rational Mech. Anal. 167
// (2003) 85: the discrete Euler-Lagrange equations of an action whose potential energy is sampled element by element.
// With one step for all it is leapfrog.
//
// Promises: order 2; linear momentum to rounding, angular momentum for forces along the line between two particles; an
// energy that oscillates and does not drift, unless steps resonate.
//
// Resonance. An impulse every H of a soft element feeds an oscillation of frequency omega where omega H is just below a
// multiple of pi, however small its stiffness k:
//     omega H in (n pi - 2 atan(H k / (2 omega)), n pi)     for unit mass and an exact oscillation between impulses.
// Other ratios of steps have narrower bands. `without_resonance` avoids them all.

#include <cstdint>
#include <memory>
#include <vector>

#include "jetlag/schedule/schedule.hpp"
#include "jetlag/tape/program.hpp"

namespace jetlag {

/// Steps of all elements [s]: one list for each group of System::elements(), in its order.
using ElementSteps = std::vector<std::vector<double>>;

/// One step for all.
ElementSteps equal_steps(const System<double>& system, double step);

/// fraction * 2 / omega_K, the share of its own Courant limit, for each element whose law bounds its stiffness k:
///     omega_K^2 = k (1/m_a + 1/m_b).     Fixed particles count as infinitely heavy.
/// A constant force limits no step: it takes the shortest of those on the same particle, or where there is none the
/// longest of all. fraction: in (0, 1].
/// Throws std::invalid_argument for another fraction, for a law that neither bounds its stiffness nor is constant, and
/// where no element has a stiffness.
ElementSteps courant_steps(const System<double>& system, double fraction);

/// Steps that resonate with no oscillation of the system: each becomes the shortest one, h, times a power of two, not
/// longer than it was and with
///     (2^l h) omega_h <= 0.8 pi,     omega_h = 2/h asin(h omega / 2),     omega = frequency_bound(system).
/// omega_h bounds every frequency of motion in steps of h. Clocks that nest repeat every H = 2^l h, the longest step, and
/// a periodic linear Hamiltonian motion loses its stability only where two of its frequencies (or one, twice) add up to
/// a multiple of 2 pi / H (M. Krein 1950; V. Arnold, Mathematical Methods of Classical Mechanics, app. 3 and 25 D):
/// below omega_h H = pi none do. The soft elements shift the frequencies that h alone would give; 0.2 pi is left for that.
/// Forces without a bound on their stiffness are not covered. Throws std::invalid_argument where the shortest step is
/// itself beyond 2/omega, and where no element has a stiffness.
ElementSteps without_resonance(const System<double>& system, ElementSteps steps);

class Avi final : public Schedule {
 public:
  /// steps: > 0 and finite; see above. Elements of equal steps share a clock and run together.
  /// Throws std::invalid_argument for steps of another shape, and for a law that is not the gradient of a potential
  /// energy in the positions alone.
  Avi(const System<double>& system, const ElementSteps& steps);
  ~Avi() override;

  /// `until` and frames lie between impulses: positions are those of the straight lines; velocities have of each last
  /// impulse h_K F_K what belongs to times up to t,
  ///     v(t) = v - sum_K (1/2 - (t - t_K)/h_K) h_K F_K / m.
  /// The clocks go on as if nobody had looked: as long as it is handed the state that it gave, a run to 1 and on to 2
  /// gives the bits of a run to 2. Any other state begins anew, with half an impulse of every element.
  ///
  /// A step, for max_steps and observers, lasts from one impulse to the next, whosever it is. Events need one clock for
  /// all: they are refused. Throws std::invalid_argument as Schedule::run does, and for events.
  Report run(State<double>& state, double until, const RunOptions& options) override;

  /// An update is one impulse on one particle; a force evaluation of an element is one element coefficient.
  const Work& work() const override { return work_; }

 private:
  class Between;
  struct Clock;
  struct Due {
    double time;
    int clock;
    friend bool operator>(const Due& a, const Due& b) {
      return a.time > b.time || (a.time == b.time && a.clock > b.clock);
    }
  };

  void add_clock(const System<double>& system, double step, const std::vector<std::vector<int>>& members);
  bool continues(const State<double>& state) const;
  bool begin(const State<double>& state, Report& report);
  bool is_due(double time) const { return reach() <= time; }
  double reach() const;
  double next_time() const;
  bool next_impulses(const RunOptions& options, Report& report);
  bool drift(const Clock& clock, double time, const RunOptions& options, Report& report);
  bool push(Clock& clock, double time, double share, Report& report);
  bool schedule(int clock, Report& report);
  State<double> at(double time) const;

  int dimension_, stride_;
  std::vector<double> push_;   // 1/m, 0 of fixed particles
  std::vector<Clock> clocks_;  // shortest step first
  std::vector<Due> due_;       // a heap: who rings next, ties by number
  // Padded rows: positions and velocities at the particles' own times; forces, of which nobody reads those on fixed ones.
  AlignedVector<double> x_, v_, f_;
  std::vector<double> own_time_;  // [s]
  double origin_ = 0, last_ = 0;  // [s]: when the clocks were started, when the last one rang
  State<double> handed_out_;
  Work work_;
};

}  // namespace jetlag
