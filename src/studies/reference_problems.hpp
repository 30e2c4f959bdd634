// SPDX-License-Identifier: MIT
#pragma once
// Initial value problems whose end values are known to 20 digits, as a user of the library would write them: bodies and
// springs as systems, the others as first-order systems.

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/forces/gravity.hpp"
#include "jetlag/integrators/first_order_taylor.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "studies/reference_values.hpp"

namespace jetlag {

/// Where a problem has ended.
struct ReferenceSolution {
  Report report;
  std::vector<double> end;   // in the order of the values
  std::vector<double> rate;  // its derivative
  std::uint64_t steps = 0;
};

/// A disturbance on the way, to see how much of it arrives: y_i grows by the fraction +-size of itself after some steps.
struct Kick {
  std::uint64_t after_steps = 0;
  double size = 0;

  template <class Numbers>
  void act_on(Numbers&& y) const {
    bool up = true;  // + + - - + + ...: neither a change of scale nor a symmetry of the problems below
    int i = 0;
    for (double& component : y) {
      component *= 1 + (up ? size : -size);
      if (++i % 2 == 0) up = !up;
    }
  }
};

struct ReferenceProblem {
  std::string name;           // of its values
  std::vector<double> start;  // in the order of the values
  double until;               // it starts at 0
  std::function<ReferenceSolution(int degree, const Kick& kick)> solve;
};

// ---- laws ------------------------------------------------------------------------------------------------

/// H = (p^2 + q^2)/2 + q_1^2 q_2 - q_2^3 / 3.         Source: Henon, Heiles, Astron. J. 69 (1964) 73.
struct HenonHeiles {
  static constexpr const char* name = "henon_heiles";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    const Vector<T, D>& q = p.position[0];
    Vector<T, D> f = -q;
    f[0] -= 2.0 * (q[0] * q[1]);
    f[1] += q[1] * q[1] - q[0] * q[0];
    return f;
  }

  template <class T, int D>
  static T energy(const Participants<T, D, 1>& p) {
    const Vector<T, D>& q = p.position[0];
    return T(0.5) * q.squaredNorm() + q[0] * q[0] * q[1] - q[1] * q[1] * q[1] / T(3.0);
  }
};

/// F_0 = d + alpha d^2, d = q_1 - q_0, q: displacements.         Source: Fermi, Pasta, Ulam, Tsingou 1955.
struct FputSpring {
  static constexpr const char* name = "fput_spring";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"alpha"};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& alpha) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    return d + T(alpha * d[0]) * d;
  }
};

// ---- first-order systems ---------------------------------------------------------------------------------

/// A body of no mass near the earth and the moon, in coordinates that turn with them: (x, y, x', y'), p = (mu).
/// Source: Arenstorf, Amer. J. Math. 85 (1963) 27.
inline constexpr auto arenstorf = [](const auto&, const auto& u, const auto& p) {
  const auto mu = p[0], rest = 1.0 - p[0];
  const auto to_earth = u[0] + mu, to_moon = u[0] - rest, yy = u[1] * u[1];
  const auto earth = rest * pow(to_earth * to_earth + yy, -1.5),
             moon = mu * pow(to_moon * to_moon + yy, -1.5);
  return std::array{u[2], u[3], u[0] + 2.0 * u[3] - earth * to_earth - moon * to_moon,
                    u[1] - 2.0 * u[2] - (earth + moon) * u[1]};
};

/// Source: DETEST, problem B1: Hull et al., SIAM J. Numer. Anal. 9 (1972) 603.
inline constexpr auto lotka_volterra = [](const auto&, const auto& y) {
  return std::array{2.0 * (y[0] - y[0] * y[1]), y[0] * y[1] - y[1]};
};

/// y_i' = p_i y_j y_k.         Source: Euler 1758; p = (1, -1, -0.51) is DETEST, problem B5.
inline constexpr auto euler_rigid = [](const auto&, const auto& y, const auto& p) {
  return std::array{p[0] * (y[1] * y[2]), p[1] * (y[2] * y[0]), p[2] * (y[0] * y[1])};
};

/// Source: DETEST, problem E2.
inline constexpr auto van_der_pol = [](const auto&, const auto& y) {
  return std::array{y[1], (1.0 - y[0] * y[0]) * y[1] - y[0]};
};

/// p = (sigma, rho, beta).         Source: Lorenz, J. Atmos. Sci. 20 (1963) 130.
inline constexpr auto lorenz = [](const auto&, const auto& y, const auto& p) {
  return std::array{p[0] * (y[1] - y[0]), y[0] * (p[1] - y[2]) - y[1], y[0] * y[1] - p[2] * y[2]};
};

/// Two equal bobs on equal rods: (theta_1, theta_2, omega_1, omega_2), p = (g / l).
inline constexpr auto double_pendulum = [](const auto&, const auto& u, const auto& p) {
  const auto difference = u[0] - u[1], first = u[2] * u[2], second = u[3] * u[3];
  const auto s = sin(difference), c = cos(difference), share = 2.0 - c * c;
  return std::array{u[2], u[3],
                    (c * (p[0] * sin(u[1]) - s * first) - s * second - 2.0 * p[0] * sin(u[0])) / share,
                    (s * (2.0 * first + 2.0 * p[0] * cos(u[0]) + c * second)) / share};
};

// ---- problems --------------------------------------------------------------------------------------------

/// A first-order system, moved by Taylor's method with the steps of Jorba and Zou.
template <class F>
ReferenceProblem of_equations(std::string name, const F& f, std::vector<double> start, double until,
                              std::vector<double> parameters = {}) {
  const auto solve = [=](int degree, const Kick& kick) {
    const int size = static_cast<int>(start.size());
    FirstOrderTaylor<> method(f, size, {.parameters = parameters, .degree = degree});
    FirstOrderState<> state{0.0, start};
    if (kick.size != 0) {
      method.run(state, until, {.max_steps = kick.after_steps});
      kick.act_on(state.y);
    }
    ReferenceSolution solution{method.run(state, until), state.y, {}, method.work().steps};
    FirstOrderExpansion<> series(f, size, parameters);
    series.start(state.time, state.y);
    series.grow();
    for (int i = 0; i < size; ++i) solution.rate.push_back(series[i][1]);
    return solution;
  };
  return {std::move(name), start, until, solve};
}

/// Particles, likewise; start: of those that are not fixed, all positions, then all velocities. The fixed ones are at 0.
inline ReferenceProblem of_system(std::string name, const System<>& system, const std::vector<double>& start,
                                  double until) {
  const int size = system.particles(), dimension = system.dimension();
  const auto each = [=, fixed = system.fixed()](auto&& rows, auto visit) {
    for (int i = 0; i < size; ++i)
      for (int c = 0; c < dimension; ++c)
        if (!fixed[i]) visit(rows(i, c));
  };
  const auto solve = [=](int degree, const Kick& kick) {
    State<> state{0.0, Coordinates<>::Zero(size, dimension), Coordinates<>::Zero(size, dimension)};
    auto next = start.begin();
    each(state.position, [&](double& x) { x = *next++; });
    each(state.velocity, [&](double& v) { v = *next++; });
    Lockstep run(taylor(system, degree, std::make_unique<JorbaZou>()));
    if (kick.size != 0) {
      RunOptions first;
      first.max_steps = kick.after_steps;
      run.run(state, until, first);
      kick.act_on(state.position.reshaped());
      kick.act_on(state.velocity.reshaped());
    }
    ReferenceSolution solution{run.run(state, until, {}), {}, {}, run.work().steps};
    Expansion<> series(system);
    series.start(state);
    series.grow();
    each(state.position, [&](double x) { solution.end.push_back(x); });
    each(state.velocity, [&](double v) { solution.end.push_back(v); });
    each(state.velocity, [&](double v) { solution.rate.push_back(v); });
    each(series.position(2), [&](double half) { solution.rate.push_back(2 * half); });
    return solution;
  };
  return {std::move(name), start, until, solve};
}

/// Bodies that attract each other, all pairs.
inline System<> attracting(int dimension, const std::vector<double>& mass, double constant = 1.0) {
  System<> system(dimension, mass);
  std::vector<std::array<int, 2>> pairs;
  for (int i = 0; i < system.particles(); ++i)
    for (int j = 0; j < i; ++j) pairs.push_back({j, i});
  system.add<Gravity>(pairs, {{constant}});
  return system;
}

/// All problems of the file of values.
inline std::vector<ReferenceProblem> reference_problems() {
  std::vector<ReferenceProblem> all;
  const double mu = 0.012277471;
  all.push_back(of_equations("arenstorf-A", arenstorf, {0.994, 0, 0, -2.00158510637908252240537862224},
                             17.0652165601579625588917206249, {mu}));
  all.push_back(of_equations("arenstorf-B", arenstorf, {0.994, 0, 0, -2.0317326295573368357302057924},
                             11.124340337266085134999734047, {mu}));
  for (const auto& [e, digits] :
       {std::pair(0.1, "0.1"), {0.3, "0.3"}, {0.5, "0.5"}, {0.7, "0.7"}, {0.9, "0.9"}}) {
    System<> sun_and_planet = attracting(2, {1.0, 1.0});
    sun_and_planet.fix(0);
    all.push_back(of_system(std::string("kepler DETEST-D e=") + digits + " t=20", sun_and_planet,
                            {1 - e, 0, 0, std::sqrt((1 + e) / (1 - e))}, 20));
  }
  all.push_back(of_equations("lotka-volterra DETEST-B1 t=20", lotka_volterra, {1, 3}, 20));
  all.push_back(of_equations("euler rigid DETEST-B5 t=20", euler_rigid, {0, 1, 1}, 20, {1, -1, -0.51}));
  // Moments of inertia 1/2, 2, 3: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.10, no forces.
  all.push_back(of_equations("euler rigid HNW t=20", euler_rigid, {1, 0, 0.9}, 20, {-2, 1.25, -0.5}));
  all.push_back(of_equations("van der Pol DETEST-E2 t=20", van_der_pol, {2, 0}, 20));
  System<> henon_heiles(2, {1.0});
  henon_heiles.add<HenonHeiles>({{0}}, {{}});
  for (const auto& [until, digits] : {std::pair(10.0, "10"), {100.0, "100"}})
    all.push_back(of_system(std::string("henon-heiles q=(0,.1) p=(.5,0) t=") + digits, henon_heiles,
                            {0, 0.1, 0.5, 0}, until));
  all.push_back(of_system("pleiades t=3", attracting(2, {1, 2, 3, 4, 5, 6, 7}),
                          {3, 3, 3, -3, -1, 2, -3, 0,     2, 0, -2,   -4, 2,    4,  //
                           0, 0, 0, 0,  0,  0, 0,  -1.25, 0, 1, 1.75, 0,  -1.5, 0},
                          3));
  const double x = 0.97000436, y = -0.24308753, u = -0.93240737, v = -0.86473146;
  all.push_back(of_system("figure-eight t=6.32591398", attracting(2, {1, 1, 1}),
                          {x, y, -x, -y, 0, 0, -u / 2, -v / 2, -u / 2, -v / 2, u, v}, 6.32591398));
  all.push_back(of_system("pythagorean m=(3,4,5) t=10", attracting(2, {3, 4, 5}),
                          {1, 3, -2, -1, 1, -1, 0, 0, 0, 0, 0, 0}, 10));
  all.push_back(
      of_equations("lorenz63 (10,28,8/3) u0=(0,1,1.05) t=5", lorenz, {0, 1, 1.05}, 5, {10, 28, 8.0 / 3.0}));
  all.push_back(of_equations("double pendulum m=l=1 g=9.81 th=(2,1) rest t=5", double_pendulum, {2, 1, 0, 0},
                             5, {9.81}));
  System<> fput(1, std::vector<double>(34, 1.0));
  std::vector<double> sine(64, 0.0);
  fput.fix(0);
  fput.fix(33);
  for (int j = 0; j < 33; ++j) fput.add<FputSpring>({{j, j + 1}}, {{0.25}});
  for (int j = 1; j <= 32; ++j) sine[j - 1] = std::sin(std::numbers::pi * j / 33);
  all.push_back(of_system("FPUT-alpha N=32 a=0.25 q_j=sin(pi j/33) t=100", fput, sine, 100));
  // Sun, Jupiter, Saturn, Uranus, Neptune, Pluto in astronomical units and days.         Source: [HLW06] I.2.4.
  all.push_back(of_system(
      "outer solar system GNI t=20000 d",
      attracting(3,
                 {1.00000597682, 0.000954786104043, 0.000285583733151, 0.0000437273164546, 0.0000517759138449,
                  1 / 1.3e8},
                 2.95912208286e-4),
      {0,           0,          0,           -3.5023653, -3.8169847, -1.5507963,  9.0755314,   -3.0458353,
       -1.6483708,  8.3101420,  -16.2901086, -7.2521278, 11.4707666, -25.7294829, -10.8169456, -15.5387357,
       -25.2225594, -3.1902382, 0,           0,          0,          0.00565429,  -0.00412490, -0.00190589,
       0.00168318,  0.00483525, 0.00192462,  0.00354178, 0.00137102, 0.00055029,  0.00288930,  0.00114527,
       0.00039677,  0.00276725, -0.00170702, -0.00136504},
      20000));
  return all;
}

}  // namespace jetlag
