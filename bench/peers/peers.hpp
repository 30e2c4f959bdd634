// SPDX-License-Identifier: MIT
#pragma once
// Maintained implementations of other methods, run as they are beside ours: what an adaptor is given and gives back.

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "jetlag/base/stopwatch.hpp"
#include "jetlag/integrators/accelerations.hpp"
#include "problems/problem.hpp"

namespace jetlag::bench {

class Reporter;

/// A system split into elements that are stiff and those that are not.
struct Split {
  System<double> fast, slow;
};

/// Fast are the elements whose first parameter says so.
Split split_by_first_parameter(const System<double>& system, const std::function<bool(double)>& fast);

struct PeerProblem : problems::Problem {
  std::optional<Split> split{};
};

/// planet, fput32, cloth20, chain128.   Throws std::invalid_argument.
const PeerProblem& peer_problem(const std::string& name);

struct Ending {
  State<double> state;
  double evaluations = 0;  // (element, order) pairs over the number of elements: a force evaluation is one
  std::string failure{};   // empty: none
};

/// What a run is asked for.
struct Asked {
  double setting;  // the step [s] or the tolerance
  double target;   // the error that is wanted [m]
  double seconds;  // of the processor: the run may fail where it takes longer
};

struct Method {
  std::string name;
  bool by_step;      // or by a tolerance
  double coarsest;   // the first setting, for steps as a part of the problem's largest
  bool uses_target;  // and not its setting alone
  std::function<bool(const PeerProblem&)> fits;
  std::function<Ending(const PeerProblem&, const Asked&)> run;
  double first_of_target = 1e-2;  // the first tolerance that is tried, over the error wanted
};

bool any_problem(const PeerProblem& problem);
/// Whether forces depend on positions only.
bool by_position(const PeerProblem& problem);
bool has_split(const PeerProblem& problem);

/// The accelerations by jetlag's own code, from and to arrays of row after row; it counts, and watches the time.
class Forces {
 public:
  Forces(const System<double>& system, double seconds);

  /// x'' at (t, x, x') -> a. False where it is not finite or the time is used up: `failure` then says which.
  bool operator()(double t, const double* x, const double* v, double* a);

  std::size_t unknowns() const { return unknowns_; }  // of x and of v each
  double element_coefficients() const { return static_cast<double>(accelerations_.element_coefficients()); }
  const std::string& failure() const { return report_.message; }
  bool out_of_time() const { return out_of_time_; }

 private:
  std::size_t unknowns_;
  Accelerations accelerations_;
  State<double> state_;
  Coordinates<double> a_;
  Report report_;
  double deadline_;
  bool out_of_time_ = false;
  std::uint32_t calls_ = 0;
};

/// (x, v) row after row, and back.
std::vector<double> flat(const State<double>& state);
State<double> state_of(const double* y, const PeerProblem& problem);

/// `until` in equal steps of at most h.
struct EqualSteps {
  EqualSteps(double until, double h);
  long count;
  double step;
};

std::vector<Method> own_methods();

/// Every peer on a small chain against a series of degree 20, at a tight setting.
struct PeerAgreement {
  static constexpr double allowed = 1e-7;  // [m]: a tolerance of 1e-9 and some 100 steps
  std::string method;
  double error;                                    // [m]
  bool holds() const { return error <= allowed; }  // not when it is NaN
};
std::vector<PeerAgreement> peer_agreements();

/// A row that was not timed because it would take too long; no failure.
inline constexpr const char* gives_up = "gives up";

/// Prints the least times of this run as tables; nothing if no peer was measured.
void print_peers(const Reporter& reporter, std::ostream& out);

}  // namespace jetlag::bench
