// SPDX-License-Identifier: MIT
#pragma once
// A law itself as the kernel: all coefficients of the motion under a single element in one function, in which the order
// is unrolled and the law is called with recurrences for scalars (series/online/online.hpp).
//
// It takes the compiler seconds, some ten for gravity in space, so that a law asks for it,
//
//     static constexpr int unrolled_orders = 20;                      // of its forces: for Taylor steps of degree 20
//     static constexpr std::array unrolled_dimensions{2, 3};          // of space; without this, all
//
// and pays where a system is a single element, in which all particles take part: a pendulum, a planet about its sun. Such a law
// has forces of its own and makes no choices, to which roots belong: a norm is one, a power -1.5 is not. In other systems, at
// higher orders, where positions carry rests (compensated sums), and on processors without fused multiply-adds it runs from its
// tape; both agree to rounding. What it gains has been measured with g++ only.

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "jetlag/base/accelerate.hpp"
#include "jetlag/forces/law.hpp"
#include "jetlag/series/online/vector.hpp"

#if defined(__x86_64__)
#if defined(__clang__)
#define JETLAG_ONE_FUNCTION [[gnu::target("avx2,fma"), gnu::flatten, gnu::noinline]]
#else  // a clone would not be flat, and with little optimisation nothing that is known would be left out
#define JETLAG_ONE_FUNCTION \
  [[gnu::target("avx2,fma"), gnu::optimize("O3"), gnu::flatten, gnu::noinline, gnu::noclone]]
#endif
#else
#define JETLAG_ONE_FUNCTION
#endif

namespace jetlag {

/// The motion of the participants of one element, who are all particles of a system. A row holds their padded coordinates.
struct MotionOfElement {
  double* position;          // row of coefficient 0; the other rows follow
  double* velocity;          // the same
  const double* time;        // the coefficients of the time [s], orders_of_histories of them
  const double* push;        // time_unit / mass of each coordinate, 0 where it is fixed [s/kg]
  double time_unit;          // [s]
  const int* rows;           // where in a row each participant is
  const double* parameters;  // those of the law, then masses
  double* histories;         // of the law, orders_of_histories numbers each
};

struct LawKernel {
  int orders = 0;  // coefficients 0 .. orders - 1 of the forces; 0: there is no kernel

  /// From coefficients k .. end - 1 of the forces the positions up to coefficient end + 1 and the velocities up to end, where those
  /// before are known and come from this kernel too. Returns how many histories it uses, which depends on nothing but
  /// the parameters; at most most_histories count.
  int (*grow)(const MotionOfElement& motion, int k, int end) = nullptr;
};

namespace detail {

/// Whether kernels of laws run on this processor.
inline bool runs_law_kernels() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

template <ForceLaw L, int D>
class UnrolledLaw {
 public:
  static constexpr int orders = L::unrolled_orders;
  static_assert(0 < orders && orders <= orders_of_histories);

  /// LawKernel::grow
  JETLAG_ONE_FUNCTION static int grow(const MotionOfElement& motion, int begin, int end) {
    int histories = 0;
    each<orders>([&](auto k) {
      if (begin <= k && k < end) histories = grow_by_one(motion, k);
    });
    return histories;
  }

  /// The kernel, or none where this processor runs none.
  static LawKernel kernel() {
    if (!runs_law_kernels()) return {};
    return {orders, &grow};
  }

 private:
  static constexpr int P = L::participants, given = forces_given<L>, row = P * padded(D);
  static constexpr int width = static_cast<int>(L::parameters.size());

  /// Coefficient k of the forces given.
  static std::array<Vector<Online, D>, given> forces(const MotionOfElement& motion, Histories& histories) {
    Participants<Online, D, P> p;
    each<P>([&](auto i) {
      each<D>([&](auto c) {
        const int at = motion.rows[i] + c;
        p.position[i][c] = Online::input(motion.position + at, row, histories);
        p.velocity[i][c] = Online::input(motion.velocity + at, row, histories);
      });
      p.mass[i] = motion.parameters[width + i];
    });
    p.time = Online::input(motion.time, 1, histories);
    return [&]<std::size_t... i>(std::index_sequence<i...>) -> std::array<Vector<Online, D>, given> {
      if constexpr (has_force<L, D, Online>)
        return {L::force(p, Online(motion.parameters[i])...)};
      else
        return L::forces(p, Online(motion.parameters[i])...);
    }(std::make_index_sequence<L::parameters.size()>());
  }

  static int grow_by_one(const MotionOfElement& motion, int k) {
    Histories histories{motion.histories, k};
    const auto f = forces(motion, histories);
    const auto coefficient = [k](const Online& u) {  // of a number: none but the first
      return u.is_number() && k > 0 ? 0.0 : u.newest().value;
    };
    const auto move = [&](int i, int c, double force) {
      const int at = motion.rows[i] + c;
      accelerate(1, k, motion.time_unit, motion.push + at, &force, motion.velocity + (k + 1) * row + at);
      motion.position[(k + 2) * row + at] = force;
    };
    each<given>([&](auto i) { each<D>([&](auto c) { move(i, c, coefficient(f[i][c])); }); });
    if constexpr (given < P)
      each<D>([&](auto c) {
        double sum = coefficient(f[0][c]);
        each<given - 1>([&](auto i) { sum += coefficient(f[i + 1][c]); });
        move(P - 1, c, -sum);
      });
    return histories.used;
  }

  template <int n, class F>
  static void each(const F& f) {
    [&]<int... i>(std::integer_sequence<int, i...>) {
      (f(std::integral_constant<int, i>()), ...);
    }(std::make_integer_sequence<int, n>());
  }
};

}  // namespace detail

/// Whether a law asks for a kernel in a dimension of space, and can have one.
template <ForceLaw L, int D>
constexpr bool is_unrolled_in() {
  if constexpr (!requires { L::unrolled_orders; } ||
                !(detail::has_force<L, D, Online> || detail::has_forces<L, D, Online>))
    return false;
  else if constexpr (requires { L::unrolled_dimensions; })
    return std::ranges::find(L::unrolled_dimensions, D) != L::unrolled_dimensions.end();
  else
    return true;
}

/// The kernel of a law in a dimension of space: none where it does not ask for one.
template <ForceLaw L, int D>
LawKernel kernel_of_law() {
  if constexpr (is_unrolled_in<L, D>())
    return detail::UnrolledLaw<L, D>::kernel();
  else
    return {};
}

}  // namespace jetlag
