// SPDX-License-Identifier: MIT
#pragma once
// Quantized state systems: what is divided into steps is the state, not the time.
//
//      x ____                    Every component of every position and velocity has a polynomial x(t) of degree n and a
//   q ______/| dQ                quantized one q(t) of degree n - 1, which is all that others see of it:
//          / |______                  x' = q_v,     v' = F(q_x, q_v) / m.
//         /     q                Where |x - q| has grown to the quantum dQ, q becomes x without its last coefficient.
//
// A component that hardly moves has hardly any events. Orders n = 1, 2, 3: QSS1, QSS2, QSS3.
// Source: E. Kofman, S. Junco, Trans. SCS 18 (2001) 123; E. Kofman, Simulation 78 (2002) 76 (QSS2); Latin American
// Applied Research 36 (2006) 101 (QSS3).
//
// Promises. On a stable linear system x' = A x, A = V L V^-1, each error stays for all time below
//     |e| <= |V| |Re(L)^-1 L| |V^-1| dQ     (of absolute values; Kofman),
// whatever the order; the number of events grows with dQ^(-1/n). Linear momentum is conserved to rounding: a pair acts
// on its two particles by one polynomial. Without damping there is no such bound: x - q acts as a force from outside.
// On x'' = -x from x = 1 with dQ = 0.001, the energy has changed after 10 periods by +8.2 % with QSS1, which always
// gains, by +0.7 % with QSS2 and by -3.8 % with QSS3, and goes on so: in proportion to dQ.
//
// Stiff systems chatter: about an equilibrium a component has events at the rate of the system, however small its
// motion. Implicit methods are for them.
//
// Cost: an event renews the forces between a particle and its neighbours and sums those on each of them anew, the
// neighbours of its neighbours: 600 us for 200 bodies that all attract each other. It is for networks.
//
// Forces are expanded along the quantized states and renewed where a quantized state changes. A force that changes for
// another reason, because it depends on the time or has a border such as the surface of a floor, is seen at the next
// event: for these `max_step` must be given.
//
// An update of a particle lasts from one event of a component of it to the next. Of events at the same time that of the
// lower number comes first: positions, particle by particle and component by component, then velocities. Where a
// component has two events at one time, because it crosses its quantum in less than the last place of the time, the run
// ends in step_underflow. A step is an event, an update is one too; element coefficients are those of the elements of a
// particle.

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "jetlag/schedule/event_driven.hpp"
#include "jetlag/schedule/event_queue.hpp"

namespace jetlag {

class QuantizedForces;

class Qss final : public EventDriven {
 public:
  struct Options {
    int order = 2;                // 1 to 3
    double quantum = 0;           // of positions [m], > 0
    double velocity_quantum = 0;  // of velocities [m/s], > 0
    double max_step =
        std::numeric_limits<double>::infinity();  // [s], > 0: each component has an event at least so often
  };

  /// Throws std::invalid_argument for options out of range, and without max_step for a law that depends on the time or
  /// whose force has a border.
  Qss(const System<double>& system, const Options& options);
  ~Qss() override;

 private:
  struct Component {
    std::array<double, 4> x{};               // [m or m/s], about x_time
    std::array<double, 3> q{};               // about q_time
    double x_time = 0, q_time = 0, due = 0;  // [s]
  };

  int number(int kind, int particle, int component) const {
    return (kind * particles_ + particle) * dimension_ + component;
  }
  bool begin(const State<double>& state, double until, Report& report) override;
  double next_time() const override;
  bool next_event(const Observer& observer, Report& report) override;
  State<double> at(double time) const override;
  Piece piece(double begin, double end) const override;
  bool advance(Component& component, double time) const;
  void move(int particle, int component, double time);
  bool push(int particle, double time, Report& report);
  void schedule(int number, double time);
  void tell(int particle, double time, const Observer& observer);
  Report not_finite(const char* what, int particle, double time) const;

  Options options_;
  int dimension_, particles_;
  std::vector<bool> fixed_;
  std::unique_ptr<QuantizedForces> forces_;
  std::vector<Component> components_;
  EventQueue queue_;
  std::vector<double> told_;  // [s]: the last event of each particle
};

}  // namespace jetlag
