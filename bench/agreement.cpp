// SPDX-License-Identifier: MIT
#include "agreement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adolc.hpp"
#include "jetlag/motion/expansion.hpp"
#include "problems.hpp"
#include "restart.hpp"

namespace jetlag::bench {

namespace {

/// component(i, c, k): coefficient k of component c of the position of particle i.
template <class Component>
double difference(const Expansion<double>& series, int degree, Component component) {
  double worst = 0.0;
  for (int k = 0; k <= degree; ++k) {
    const auto x = series.position(k);
    const double scale = x.cwiseAbs().maxCoeff();
    for (int i = 0; i < x.rows(); ++i)
      for (int c = 0; c < x.cols(); ++c) {
        const double apart = std::abs(x(i, c) - component(i, c, k)) / scale;
        if (std::isnan(apart)) return std::numeric_limits<double>::quiet_NaN();
        worst = std::max(worst, apart);
      }
  }
  return worst;
}

}  // namespace

std::vector<Agreement> agreements() {
  std::vector<Agreement> all;
  for (const char* name : {"cloth10", "kepler"}) {
    const Problem problem = bench::problem(name);
    constexpr int degree = JetRestart::max_degree;
    Expansion<double> series(problem.system, degree);
    series.start(problem.start);
    series.grow_to(degree);

    JetRestart jets(problem.system);
    jets.expand(problem.start, degree);
    all.push_back({"jets, restarted", name, degree,
                   difference(series, degree, [&](int i, int c, int k) { return jets.series(i, c)[k]; })});
    for (const auto* table : available_kernels()) {
      Expansion<double> other(problem.system, degree, *table);
      other.start(problem.start);
      other.grow_to(degree);
      all.push_back(
          {std::string("tape, ") + table->instruction_set, name, degree,
           difference(series, degree, [&](int i, int c, int k) { return other.position(k)(i, c); })});
    }
#if defined(JETLAG_HAVE_ADOLC)
    AdolC& adolc = bench::adolc(name);
    adolc.expand(problem.start, degree);
    all.push_back({"ADOL-C", name, degree,
                   difference(series, degree, [&](int i, int c, int k) { return adolc.series(i, c)[k]; })});
#endif
  }
  return all;
}

}  // namespace jetlag::bench
