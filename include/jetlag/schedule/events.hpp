// SPDX-License-Identifier: MIT
#pragma once
// Events: times at which a function of the state crosses zero, and what happens there.
//
//   RunOptions options;
//   options.events = {{.name = "floor",
//                      .g = [](const auto& t, const auto& x, const auto& v) { return x(0, 1); },
//                      .direction = Direction::falling,
//                      .change = [](State<double>& state) { state.velocity(0, 1) *= -0.9; }}};
//   schedule.run(state, 10.0, options);                     // a ball that bounces
//
// What a crossing is.
//   - g has Taylor series during a step (motion/observable.hpp), one for each part between its kinks; an event is a change of
//     its sign, and none is missed that rises out of rounding. Touching without crossing is none, and neither is a g that is
//     zero throughout. A g that is zero but for rounding, such as an invariant of the motion, crosses at random.
//   - Where g is zero for a while (max(x - 1, 0) + min(x, 0)) the signs before and after count: it crosses where it leaves zero
//     to the other side, once, whatever the steps are. Where it stays at zero, or goes back, it does not cross.
//   - A change of sign at a jump or a pole is no event. After a jump g begins anew: one that has jumped to zero leaves it to
//     either side without firing. Where g ends (the root of what becomes negative) the run ends as non_finite, and the
//     report names the event and the time; what happens before in that step is handed out, though the state is that of
//     its beginning.
//   - Its time is the first double after the change: g changes sign between the double before and it. The clock itself
//     is off by half an ulp (motion/trajectory.hpp), the motion by the error of its method.
//   - At the ends of steps and runs g of the state decides: a crossing there is found once, before or after.
//   - A state that begins on the event (g = 0) does not fire; neither does the jump that a change() makes. A run does not
//     know what another one has seen: where it begins while g is zero for a while, g leaves without firing.
//   - Events at the same time come in the order of their numbers.
// A run that stops at a terminal event has passed it: g of its state has the new sign or is zero. So it can go on from
// there and the event does not fire again. For that it may stop a few doubles later than the crossing, as many as the
// rounding of g(state) over |g'| demands.
//
// Cost: without events none. A coordinate costs a step 0.1 us where it stays away from zero or goes one way without crossing,
// a crossing of it 1 us; another function its series in each step in which it comes near zero, one that is not linear in all:
// sin(x) of degree 20 takes 5 us.

#include <functional>
#include <string>

#include "jetlag/motion/observable.hpp"

namespace jetlag {

/// Which crossings count: rising is from negative to positive.
enum class Direction { any, rising, falling };

struct EventHit {
  int event;            // its number in RunOptions::events
  double time;          // [s]
  bool rising;          // from negative to positive
  State<double> state;  // at that time, before any change
};

struct Event {
  std::string name;
  Observable g;
  Direction direction = Direction::any;

  /// Whether the run ends at the crossing, as Outcome::event.
  bool terminal = false;

  /// Called at each crossing that counts, in order of time.
  std::function<void(const EventHit&)> callback = {};

  /// Changes the state at the crossing, as an impact does; the run goes on from the new state. It keeps the time and
  /// the shape. Where g stays at zero the state counts as on the event: it leaves to either side without firing.
  std::function<void(State<double>&)> change = {};
};

}  // namespace jetlag
