// SPDX-License-Identifier: MIT
#pragma once
// A force on single particles by a lambda:
//
//   const double g = 9.81, length = 0.5;
//   system.add<1>("pendulum", [=](const auto& p) {  // 1: the dimension of space
//     using std::sin;
//     auto force = p.position[0];                   // a vector, of which every component is set [N]
//     force[0] = -p.mass[0] * (g / length) * sin(p.position[0][0]);
//     return force;
//   }, {0, 1});                                     // the particles it acts on
//
// It is called once, when it is recorded (forces/force.hpp), with what it has captured then, and returns a vector: an expression
// refers to what is gone, (-p.position[0]).eval() does not. Forces between particles, parameters that differ from element to
// element, an energy, a kernel (forces/law_kernel.hpp), numbers beyond double are for a law, a struct.

#include <array>
#include <string>
#include <type_traits>
#include <utility>

#include "jetlag/forces/force.hpp"

namespace jetlag {

namespace detail {
/// A law that calls a lambda while it is recorded.
template <class F, int dimension>
struct LambdaLaw {
  static constexpr const char* name = "lambda";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};
  static constexpr std::array dimensions{dimension};
  static thread_local inline const F* lambda = nullptr;

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    static_assert(std::is_same_v<std::decay_t<decltype((*lambda)(p))>, Vector<T, D>>,
                  "the lambda of a force must return a vector, not an expression: (..).eval()");
    return (*lambda)(p);
  }
};
}  // namespace detail

/// The law of a force on one particle in D dimensions, force(p) for p of Participants<T, D, 1>.
template <int D, class F>
RecordedLaw record_lambda(std::string name, const F& force) {
  static_assert(1 <= D && D <= 3, "space has 1, 2 or 3 dimensions");
  using Law = detail::LambdaLaw<F, D>;
  struct Lent {
    explicit Lent(const F& lambda) { Law::lambda = &lambda; }
    ~Lent() { Law::lambda = nullptr; }
  };
  const Lent lent(force);
  RecordedLaw law = record_law<Law>(D);
  law.name = std::move(name);
  return law;
}

}  // namespace jetlag
