// SPDX-License-Identifier: MIT
#include "jetlag/integrators/state_variance.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace jetlag {

namespace {

/// The terms of positions and velocities at a step.
class Terms {
 public:
  Terms(const Expansion<double>& series, int degree, double h, VelocitySeries velocity)
      : series_(series), s_(h / series.time_unit()), h_(h), own_(velocity == VelocitySeries::own_series) {
    const int order = order_needed(degree, velocity);
    if (series.order() < order)
      throw std::invalid_argument("state_variance: the series must be known to order " +
                                  std::to_string(order) + ", it is to order " +
                                  std::to_string(series.order()));
  }
  Coordinates<double> position(int n) const { return std::pow(s_, n) * series_.position(n); }
  Coordinates<double> velocity(int n) const {
    if (own_) return std::pow(s_, n) * series_.velocity(n);
    return n / h_ * position(n);
  }

 private:
  const Expansion<double>& series_;
  double s_, h_;
  bool own_;
};

/// Positions and velocities, one above the other, so that they may be summed together.
Coordinates<double> stacked(const Terms& terms, int n, int particles, int dimension) {
  Coordinates<double> both(2 * particles, dimension);
  both << terms.position(n), terms.velocity(n);
  return both;
}

/// The variance of each component: random_part with the square of each.
template <class Term>
Coordinates<double> variances(const TruncationLaw& law, const Coordinates<double>& zero, const Term& term) {
  Coordinates<double> tail = zero, sum = zero;
  const bool coupled = law.weighting() == Weighting::coupled_sum;
  for (int n = law.max_degree(); n > law.min_degree(); --n) {
    const Coordinates<double> c = term(n);
    tail += c;
    sum += coupled ? Coordinates<double>((law.weight(n) - law.weight(n - 1)) * tail.cwiseAbs2())
                   : Coordinates<double>(c.cwiseAbs2() / law.exactly(n));
  }
  return coupled ? sum : Coordinates<double>(sum - tail.cwiseAbs2());
}

}  // namespace

StateVariance state_variance(const Expansion<double>& series, const TruncationLaw& law, double h,
                             VelocitySeries velocity) {
  const Terms terms(series, law.max_degree(), h, velocity);
  const Coordinates<double> zero = Coordinates<double>::Zero(series.particles(), series.dimension());
  return {variances(law, zero, [&](int n) { return terms.position(n); }),
          variances(law, zero, [&](int n) { return terms.velocity(n); })};
}

double random_energy(const System<double>& system, const Expansion<double>& series, const TruncationLaw& law,
                     double h, VelocitySeries velocity) {
  const int particles = series.particles(), dimension = series.dimension();
  const Terms terms(series, law.max_degree(), h, velocity);
  const auto term = [&](int n) { return stacked(terms, n, particles, dimension); };
  const Coordinates<double> zero = Coordinates<double>::Zero(2 * particles, dimension);
  Coordinates<double> mean = zero;
  for (int n = law.max_degree(); n >= 0; --n) mean += term(n);

  EnergyMeter meter(system);
  const auto energy = [&](const Coordinates<double>& position, const Coordinates<double>& v) {
    return meter({series.time() + h, position, v});
  };
  const Coordinates<double> at = mean.topRows(particles),
                            rest = Coordinates<double>::Zero(particles, dimension);
  const double here = energy(at, rest).potential, scale = std::max(at.cwiseAbs().maxCoeff(), 1e-300);
  const auto form = [&](const Coordinates<double>& s) {
    const Coordinates<double> q = s.topRows(particles), v = s.bottomRows(particles);
    const double kinetic = energy(at, v).kinetic, size = q.cwiseAbs().maxCoeff();
    if (size == 0.0) return kinetic;
    const double stretch = 1e-4 * scale / size;
    const double bent =
        (energy(at + stretch * q, rest).potential - here) + (energy(at - stretch * q, rest).potential - here);
    return kinetic + bent / (2 * stretch * stretch);
  };
  return random_part(law, zero, term, form);
}

}  // namespace jetlag
