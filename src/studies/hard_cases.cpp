// SPDX-License-Identifier: MIT
// The motions. Source of the ends: Taylor series in 75-digit arithmetic, each repeated at a second order, but where a
// closed form is named.
#include "studies/hard_cases.hpp"

#include <cmath>
#include <numbers>

#include "jetlag/forces/floor.hpp"
#include "jetlag/forces/spring.hpp"
#include "jetlag/forces/uniform_field.hpp"
#include "studies/reference_problems.hpp"

namespace jetlag {

namespace {

/// F = (k + c |d|^2) d, d = q_1 - q_0, q: displacements;   E = k/2 |d|^2 + c/4 |d|^4.
struct Duffing {
  static constexpr const char* name = "duffing spring";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"linear", "cubic"};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& linear, const T& cubic) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    return T(linear + cubic * d.squaredNorm()) * d;
  }
  template <class T, int D>
  static T energy(const Participants<T, D, 2>& p, const T& linear, const T& cubic) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    const T s = d.squaredNorm();
    return s * (T(0.5) * linear + T(0.25) * cubic * s);
  }
};

/// F = k d, d = q_1 - q_0, q: displacements.
struct LinearSpring {
  static constexpr const char* name = "linear spring";
  static constexpr int participants = 2;
  static constexpr std::array parameters{"stiffness"};
  static constexpr int stiffness_parameter = 0;

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 2>& p, const T& stiffness) {
    return stiffness * Vector<T, D>(p.position[1] - p.position[0]);
  }
  template <class T, int D>
  static T energy(const Participants<T, D, 2>& p, const T& stiffness) {
    const Vector<T, D> d = p.position[1] - p.position[0];
    return T(0.5) * stiffness * d.squaredNorm();
  }
};

/// The equations of Lorenz as forces on a unit mass that starts with the velocity they prescribe:
///     x'' = sigma (y' - x'),   y'' = x' (rho - z) - x z' - y',   z'' = x' y + x y' - beta z'.
struct LorenzForce {
  static constexpr const char* name = "lorenz";
  static constexpr int participants = 1;
  static constexpr std::array<const char*, 0> parameters{};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p) {
    const Vector<T, D>&x = p.position[0], &v = p.velocity[0];
    Vector<T, D> f = Vector<T, D>(-v);  // of every component, so that all of them are set
    f[0] = 10.0 * (v[1] - v[0]);
    if constexpr (D == 3) {
      f[1] = v[0] * (28.0 - x[2]) - x[0] * v[2] - v[1];
      f[2] = v[0] * x[1] + x[0] * v[1] - (8.0 / 3.0) * v[2];
    }
    return f;
  }
};

/// A body of no mass near the earth and the moon, in axes that turn with them.         Source: as `arenstorf`.
struct ArenstorfForce {
  static constexpr const char* name = "arenstorf";
  static constexpr int participants = 1;
  static constexpr std::array parameters{"mu"};

  template <class T, int D>
  static Vector<T, D> force(const Participants<T, D, 1>& p, const T& mu) {
    const Vector<T, D>&x = p.position[0], &v = p.velocity[0];
    const T to_earth = x[0] + mu, to_moon = x[0] - (1.0 - mu), yy = x[1] * x[1];
    const T earth = (1.0 - mu) * pow(to_earth * to_earth + yy, -1.5),
            moon = mu * pow(to_moon * to_moon + yy, -1.5);
    Vector<T, D> f = Vector<T, D>(-v);
    f[0] = x[0] + 2.0 * v[1] - earth * to_earth - moon * to_moon;
    f[1] = x[1] - 2.0 * v[0] - (earth + moon) * x[1];
    return f;
  }
};

using Rows = std::vector<std::vector<double>>;

Coordinates<double> rows(const Rows& numbers) {
  Coordinates<double> all(numbers.size(), numbers.front().size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    for (std::size_t c = 0; c < numbers[i].size(); ++c) all(i, c) = numbers[i][c];
  return all;
}

HardCase of(std::string name, std::string difficulty, System<double> system, const Rows& position,
            const Rows& velocity, double until, const Rows& end) {
  return {std::move(name),
          std::move(difficulty),
          std::make_shared<const System<double>>(std::move(system)),
          {0.0, rows(position), rows(velocity)},
          until,
          rows(end)};
}

/// A planet (particle 1) round a fixed sun.
HardCase kepler(double e, const char* digits, double until, const std::vector<double>& end) {
  System<double> system = attracting(2, {1.0, 1.0});
  system.fix(0);
  return of(std::string("H1 planet, e = ") + digits, "a close passage in each period", std::move(system),
            {{0, 0}, {1 - e, 0}}, {{0, 0}, {0, std::sqrt((1 + e) / (1 - e))}}, until, {{0, 0}, end});
}

/// wall - k_0 - m_1 - k_1 - m_2 .. [- k_n - wall]: displacements and velocities of the masses.
System<double> line(const std::vector<double>& mass, const std::vector<double>& stiffness) {
  std::vector<double> all{1.0};
  all.insert(all.end(), mass.begin(), mass.end());
  const bool second_wall = stiffness.size() > mass.size();
  if (second_wall) all.push_back(1.0);
  System<double> system(1, all);
  system.fix(0);
  if (second_wall) system.fix(static_cast<int>(all.size()) - 1);
  for (std::size_t i = 0; i < stiffness.size(); ++i)
    system.add<LinearSpring>({{static_cast<int>(i), static_cast<int>(i) + 1}}, {{stiffness[i]}});
  return system;
}

/// Two unit masses between walls, springs 100, 1, 1; from q = (1, -1/2) at rest:
///     q(t) = cos(sqrt(K) t) q,      K = (101 -1; -1 2),
/// for a and b the eigenvalues of K, f(K) = (f(a) (K - b) - f(b) (K - a)) / (a - b).
HardCase resonance() {
  constexpr double until = 1000, half_gap = 49.5, mean = 51.5;  // of the diagonal 101, 2
  const std::array start{1.0, -0.5}, kicked{101 * start[0] - start[1], 2 * start[1] - start[0]};  // q, K q
  const double radius = std::hypot(half_gap, 1.0), a = mean + radius, b = 201 / a;  // det K = 201
  std::array<double, 2> end;
  for (int i = 0; i < 2; ++i)
    end[i] = (std::cos(std::sqrt(a) * until) * (kicked[i] - b * start[i]) -
              std::cos(std::sqrt(b) * until) * (kicked[i] - a * start[i])) /
             (2 * radius);
  return of("H6 stiff and soft mass", "multiples of steps resonate", line({1, 1}, {100, 1, 1}),
            {{0}, {start[0]}, {start[1]}, {0}}, {{0}, {0}, {0}, {0}}, until, {{0}, {end[0]}, {end[1]}, {0}});
}

/// A spring that collapses exactly: a harmonic motion about 1 or -1, on whichever side the mass is. It crosses at asin(5/6)
/// and a half turn of 2 (pi - atan(sqrt(.44))) later, and is at 1 - cos t + sqrt(.44) sin t after that.
double collapsed_at_ten() {
  const double speed = std::sqrt(0.44),
               since = 10 - std::asin(5.0 / 6) - 2 * (std::numbers::pi - std::atan(speed));
  return 1 - std::cos(since) + speed * std::sin(since);
}

/// A unit mass dropped from 1 m onto a floor of 1e4 N/m, ten times: a fall to the speed v, s'' = g - w^2 s for
/// 2 (pi - atan(v w / g)) / w, and back to where it was.
HardCase bounces() {
  constexpr double g = 9.81, w = 100;
  const double v = std::sqrt(2 * g);
  System<double> system(2, {1.0});
  system.add<UniformField>({{0}}, {{0.0, -g, 0.0}});
  system.add<Floor>({{0}}, {{w * w, 0.0, 0.0, 1.0, 0.0}});
  return of("H11 contact", "a mass bounces on a stiff floor", std::move(system), {{0, 1}}, {{0.1, 0}},
            10 * (2 * v / g + 2 * (std::numbers::pi - std::atan(v * w / g)) / w),
            {{(2 * v / g + 2 * (std::numbers::pi - std::atan(v * w / g)) / w), 1}});
}

}  // namespace

std::vector<HardCase> hard_cases() {
  std::vector<HardCase> all;
  all.push_back(kepler(0.9, "0.9", 20, {-1.295266250987574367717139, 0.4003938963792321527297696}));
  all.push_back(kepler(0.99, "0.99", 100, {-0.9388973273317407724449242, -0.1408830418653664609724341}));
  all.push_back(kepler(0.999, "0.999", 100, {-0.9573122285019766715756194, -0.04467131067346635677615}));
  all.push_back(of("H2 three bodies from rest", "encounters of 4e-4, chaos", attracting(2, {3, 4, 5}),
                   {{1, 3}, {-2, -1}, {1, -1}}, {{0, 0}, {0, 0}, {0, 0}}, 20,
                   {{3.00429263669639920544772, 0.51192523502468586559768},
                    {-1.38862653751089539245553, -0.47047605025272216812795},
                    {-0.69167434200912320931042, 0.06922569918736621514375}}));
  all.push_back(of("H3 masses 1 and 1e-6", "a fast light mass on a slow heavy one", line({1, 1e-6}, {1, 1}),
                   {{0}, {0}, {0}}, {{0}, {1}, {0}}, 100,
                   {{0}, {-0.5064085032404720146348}, {-0.5063947665026834389444}}));
  all.back().stiff = {2};
  all.back().slow = {1};
  all.push_back(of("H3 springs 1 and 1e6", "a stiff spring after a soft one", line({1, 1}, {1, 1e6}),
                   {{0}, {0}, {1e-3}}, {{0}, {1}, {0}}, 100,
                   {{0}, {0.7062645918419748759951}, {0.7074878714915396950005}}));
  all.back().stiff = {1, 2};
  System<double> henon_heiles(2, {1.0});
  henon_heiles.add<HenonHeiles>({{0}}, {{}});
  all.push_back(of("H4 Henon-Heiles, chaotic", "disturbances grow 7.6e4 times", std::move(henon_heiles),
                   {{0, 0}}, {{0.56, 0.08}}, 100,
                   {{-0.1897889011958567181822281, 0.1082076197948636723753129}}));
  for (const auto& [delta, digits, end] :
       {std::tuple(1e-1, "0.1", std::vector{0.52966029309327483381507699, -0.82583380869474958566542626}),
        {1e-3, "1e-3", {1.263029561342757868655169, -0.084835542224449331469822793}},
        {1e-6, "1e-6", {1.2661229803496504181608035, -0.00020477246036047531671662606}},
        {0.0, "0", {collapsed_at_ten(), 0}}}) {
    System<double> spring(2, {1.0, 1.0});
    spring.fix(0);
    spring.add<Spring>({{0, 1}}, {{1.0, 1.0}});
    all.push_back(of(std::string("H5 spring collapses, ") + digits, "the force turns round in an instant",
                     std::move(spring), {{0, 0}, {1, 0}}, {{0, 0}, {-1.2, delta}}, 10, {{0, 0}, end}));
  }
  all.push_back(resonance());
  all.back().stiff = {1};
  all.back().slow = {2};
  System<double> lorenz(3, {1.0});
  lorenz.add<LorenzForce>({{0}}, {{}});
  all.push_back(of("H7 Lorenz", "chaos; forces depend on velocities", std::move(lorenz), {{-10, -1, 40}},
                   {{10 * (-1 + 10), -10 * (28 - 40) + 1, 10 - 8.0 / 3.0 * 40}}, 10,
                   {{4.228562964151610546011453, 0.7458347709009345752019322, 27.28032962198835979290540}}));
  all.push_back(of("H8 Pleiades", "seven bodies, close passages", attracting(2, {1, 2, 3, 4, 5, 6, 7}),
                   {{3, 3}, {3, -3}, {-1, 2}, {-3, 0}, {2, 0}, {-2, -4}, {2, 4}},
                   {{0, 0}, {0, 0}, {0, 0}, {0, -1.25}, {0, 1}, {1.75, 0}, {-1.5, 0}}, 3,
                   {{0.370613914397051290093951, -3.94343758551739205527788},
                    {3.23728409205723309280333, -3.27138097397254992802068},
                    {-3.22255903241832334710013, 5.22508184345654419243874},
                    {0.659709145577530835934996, -2.59061243497746951081119},
                    {0.342558170715657979037736, 1.198213693392274637514},
                    {1.56217210140063101604571, -0.242968234493582340916112},
                    {-0.700309292221249538514733, 1.09144924042897974788206}}));
  System<double> arenstorf_orbit(2, {1.0});
  arenstorf_orbit.add<ArenstorfForce>({{0}}, {{0.012277471}});
  all.push_back(of("H9 Arenstorf", "passages of the moon; forces depend on velocities",
                   std::move(arenstorf_orbit), {{0.994, 0}}, {{0, -2.00158510637908252240537862224}},
                   17.0652165601579625588917206249, {{0.994, 0}}));

  // x_0 and x_1: mean and difference of each stiff pair, over sqrt(2).         Source: [HLW06] I.5.
  constexpr double omega = 50, r = std::numbers::sqrt2 / 2;
  const auto masses = [](const std::array<double, 3>& mean, const std::array<double, 3>& difference) {
    Rows all(8, {0.0});
    for (int i = 0; i < 3; ++i) {
      all[2 * i + 1][0] = r * (mean[i] - difference[i]);
      all[2 * i + 2][0] = r * (mean[i] + difference[i]);
    }
    return all;
  };
  System<double> fput(1, std::vector<double>(8, 1.0));
  fput.fix(0);
  fput.fix(7);
  for (int i = 0; i < 7; ++i)
    fput.add<Duffing>({{i, i + 1}}, {i % 2 == 0 ? std::array{0.0, 4.0} : std::array{omega * omega / 2, 0.0}});
  all.push_back(of(
      "H10 stiff and soft springs", "fast oscillations exchange energy slowly", std::move(fput),
      masses({1, 0, 0}, {1 / omega, 0, 0}), masses({1, 0, 0}, {1, 0, 0}), 10,
      masses({1.04205763710250895438097, 0.243635570363191095817151, -0.106360437964649122662849},
             {-0.0275579312012573383034702, -0.0005927177946675771468034, 0.000395054059610075512822745})));
  all.push_back(bounces());
  return all;
}

}  // namespace jetlag
