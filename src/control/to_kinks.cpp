// SPDX-License-Identifier: MIT
#include "jetlag/control/to_kinks.hpp"

#include <algorithm>

#include "jetlag/motion/expansion.hpp"

namespace jetlag {

namespace {

/// Plain sums of the series of a motion up to `last`.
class SeriesPaths final : public Paths {
 public:
  SeriesPaths(const Expansion<double>& series, int last) : series_(series), last_(last) {}
  double now() const override { return series_.time(); }
  void velocity(int particle, double* v) const override {
    const auto velocity = series_.velocity(0);
    for (int c = 0; c < series_.dimension(); ++c) v[c] = velocity(particle, c);
  }
  void at(int particle, double s, double* x) const override {
    if (s == 0) {
      const auto place = series_.position(0);
      for (int c = 0; c < series_.dimension(); ++c) x[c] = place(particle, c);
      return;
    }
    const double u = s / series_.time_unit();
    for (int c = 0; c < series_.dimension(); ++c) x[c] = 0;
    for (int n = last_; n >= 0; --n) {
      const auto coefficient = series_.position(n);
      for (int c = 0; c < series_.dimension(); ++c) x[c] = x[c] * u + coefficient(particle, c);
    }
  }

 private:
  const Expansion<double>& series_;
  int last_;
};

}  // namespace

ToKinks::ToKinks(const Model<double>& model, std::unique_ptr<Control> inner)
    : inner_(std::move(inner)),
      steps_(inner_->is_given() ? StepsToKinks() : StepsToKinks(model)),
      fixed_(model.fixed()) {}

ToKinks::ToKinks(const ToKinks& other)
    : Control(other),
      inner_(other.inner_->clone()),
      steps_(other.steps_),
      fixed_(other.fixed_),
      left_at_(other.left_at_) {}

double ToKinks::propose(const Prospect& prospect) {
  const double h = cropped(inner_->propose(prospect), prospect.limit);
  at_kinks_.clear();
  if (steps_.none() || is_given() || !std::isfinite(h)) return h;
  const double shortened = up_to_kinks(h, prospect);
  if (shortened < h)
    for (const Kinks::Step& step : steps_.late()) at_kinks_.push_back(step.particle);
  std::ranges::sort(at_kinks_);
  return shortened;
}

double ToKinks::up_to_kinks(double h, const Prospect& prospect) {
  const Expansion<double>& series = prospect.series;
  const CoefficientView<double> x = series.position(0), v = series.velocity(0);
  if (left_at_.rows() != x.rows() || left_at_ != x) steps_.kinks().forget();
  const int last = std::min(series.order(), prospect.law.max_degree());
  series.curve(last, h / series.time_unit(), curve_);
  steps_.begin();
  for (int i = 0; i < series.particles(); ++i)
    if (!fixed_[i]) steps_.take({i, h, curve_[i]}, series.time(), x.row(i).data(), v.row(i).data());
  if (!steps_.any_late()) return h;
  // Beyond a kink the next step may be no longer than the way.
  const double depth = std::max({past_kinks(), depth_of_rounding(series.norm(0)),
                                 StepsToKinks::least(series.time()) * series.velocity_norm(0)});
  double shortest = h;
  for (const Kinks::Step& step :
       steps_.shortened(depth, SeriesPaths(series, last), last, series.time_unit(),
                        [&](int particle, int k) { return series.norm_of(particle, k); }))
    shortest = std::min(shortest, step.h);
  return shortest;
}

void ToKinks::exchange(Trajectory& other) {
  std::swap(inner_, other.control);
  steps_.kinks().exchange(other.tracks);
  std::swap(left_at_, other.left_at);
}

}  // namespace jetlag
