// SPDX-License-Identifier: MIT
#pragma once
// The motion of particles with clocks of their own: a series for each, about the tick at which it was last updated, and
// the update of a group of particles at one tick.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "jetlag/base/outcome.hpp"
#include "jetlag/base/work.hpp"
#include "jetlag/control/courant.hpp"
#include "jetlag/control/last_two.hpp"
#include "jetlag/control/to_kinks.hpp"
#include "jetlag/model/changing_elements.hpp"
#include "jetlag/motion/expansion.hpp"
#include "jetlag/motion/partial_expansion.hpp"
#include "jetlag/motion/piece.hpp"
#include "jetlag/schedule/clock_options.hpp"
#include "jetlag/schedule/ticks.hpp"
#include "jetlag/truncation/stops.hpp"

namespace jetlag {

class SeriesNow;

class LocalMotion {
 public:
  using Count = Ticks::Count;

  LocalMotion(ModelAlong along, const TruncationLaw& law, const ClockOptions& options);

  ~LocalMotion();

  /// With the elements that there are now.
  const Model<double>& model() const { return along_.model(); }
  const std::vector<int>& moving() const { return moving_; }
  const ClockOptions& options() const { return options_; }
  /// The highest one of the law.
  int degree() const { return stops_.law().max_degree(); }

  /// The series become constant: the state, at tick 0 of these ticks.
  /// Throws std::invalid_argument for a state of another shape and for a fixed particle that is not at rest.
  void begin(const State<double>& state, const Ticks& ticks);
  const Ticks& ticks() const { return ticks_; }

  /// A place for groups that do not change.
  PartialExpansion group() const { return PartialExpansion(model(), order_); }
  std::vector<int>& places() { return places_; }

  /// Elements that come and go, of particles that are about to be updated: whether the model is another. Groups then move to it.
  bool change_elements(Count now, std::span<const int> due);

  /// New series for the particles of a group, expanded together about a tick, or for all. On failure nothing changes,
  /// and the report says where.
  bool update(PartialExpansion& group, Count now, Report& report);
  bool update_all(Count now, Report& report);

  /// Whether the forces on all particles agree with their series at a time [s] at which these end.
  bool agree_at(double time, Report& report);

  /// How far a particle may go by its own series [s]; at most max_step.
  double step_of(int particle) const;
  /// The first level from `coarsest` on whose step is no longer than that; beyond the finest where there is none.
  int level_of(int particle, int coarsest);

  /// Shortens steps that particles are about to take where a kink of a force lies within them, or the change of a choice that
  /// a force makes, or one of the elements that come and go. They come in order and have just been updated; step_of(i): the step [ticks] of any particle from where it
  /// began. `shortened` gets them, and those that were to go farther in a step that has begun before.
  template <class StepOf>
  void up_to_kinks(Count now, std::span<const int> particles, const StepOf& step_of,
                   std::vector<Kinks::Step>& shortened) {
    shortened.clear();
    if (!to_kinks_.none()) {
      to_kinks_.begin();
      for (int i : particles) {
        const double h = ticks_.seconds(step_of(i));
        to_kinks_.take({i, h, curve(i, h)}, ticks_.time(now), series(i), series(i) + stride_);
      }
      if (to_kinks_.any_late()) shorten_late(now, shortened);
    }
    if (watches_)
      up_to_changes(
          now, particles, [&](int i) { return ticks_.seconds(begin_[i] + step_of(i) - now); }, shortened);
    if (!along_.none())
      up_to_other_elements(
          now, particles, [&](int i) { return ticks_.seconds(begin_[i] + step_of(i) - now); }, shortened);
  }
  /// Why the elements that come and go let the motion not go on; success: they do.
  const Report& elements() const { return elements_report_; }
  /// A particle whose choices have changed 100 times in a row with next to no time in between; -1: none.
  int sliding() const { return sliding_; }

  /// Keeps the series of those particles of a group that may cross a kink before their update.
  void remember(std::span<const int> particles);
  const std::vector<int>& former() const { return former_; }
  /// Whether the motion of the k-th of them is at a tick where its former series was to lead it: to the tolerance, and to
  /// what that series errs by beyond the step h that it asked for, in time s from its beginning: (0.7 s / h)^N tolerances.
  bool keeps_its_word(std::size_t k, Count tick) const;
  /// A particle that must be remembered at its next update.
  void doubt(int particle) {
    if (!to_kinks_.none()) to_kinks_.kinks().doubt(particle);
    if (watches_) to_change_[particle] = true;
    if (!along_.none()) to_other_elements_[particle] = true;
    natural_[particle] = step_of(particle);
  }

  Count begin_of(int particle) const { return begin_[particle]; }
  std::uint64_t updates_of(int particle) const { return updates_[particle]; }

  /// The state at a time [s] or a tick, from all series.
  State<double> at(double t) const;
  State<double> at_tick(Count now) const;
  /// All series about a tick or a time [s].
  Piece piece(Count begin, double end) const {
    return piece_about(ticks_.time(begin), end, [&](int i) { return ticks_.seconds(begin - begin_[i]); });
  }
  Piece piece(double begin, double end) const {
    return piece_about(begin, end, [&](int i) { return ticks_.since(begin_[i], begin); });
  }
  /// The position of a particle on its present series, `ticks` after it began: shape (dimension).
  void position(int particle, Count ticks, double* x) const {
    evaluate(particle, ticks_.seconds(ticks), x, nullptr);
  }

  const Work& work() const { return work_; }
  const std::optional<CourantFrequency>& courant_frequency() const { return frequency_; }
  void count_wake_up() { ++work_.wake_ups; }
  int degree_of(int particle) const { return degree_[particle]; }

  /// What others are told of a particle: coefficients 0 .. degree() of its series with the weights of its degree, `stride` numbers each.
  void told(int particle, double* to) const;
  std::size_t told_size() const { return size_; }

  /// The series of a particle, shape (orders, padded dimension), and its sums s [s] after it began; v may be null.
  const double* series(std::size_t particle) const { return series_.data() + particle * size_; }
  void evaluate(int particle, double s, double* x, double* v) const {
    evaluate(series(particle), degree_[particle], s, x, v);
  }

 private:
  double* series(std::size_t particle) { return series_.data() + particle * size_; }
  /// From a series of such a degree.
  void evaluate(const double* c, int degree, double s, double* x, double* v) const;
  /// The largest component of coefficient k of a particle.
  double norm_of(int particle, int k) const {
    const double* c = series(particle) + k * stride_;
    double most = 0;
    for (int d = 0; d < stride_; ++d) most = std::max(most, std::abs(c[d]));
    return most;
  }
  LastTwoSizes sizes_of(int particle) const;
  double curve(int particle, double h) const;
  template <int stride>
  double curve_padded(int particle, double h) const;
  void shorten_late(Count now, std::vector<Kinks::Step>& shortened);
  void up_to_changes(Count now, std::span<const int> particles, const std::function<double(int)>& left,
                     std::vector<Kinks::Step>& shortened);
  double beyond_change(std::span<const int> particles, Count now) const;
  void up_to_other_elements(Count now, std::span<const int> particles, const std::function<double(int)>& left,
                            std::vector<Kinks::Step>& shortened);
  bool in_doubt(int particle) const {
    return (!to_kinks_.none() && to_kinks_.kinks().in_doubt(particle)) || (watches_ && to_change_[particle]);
  }
  void begin_elements(const State<double>& state);
  void set_ticks(const Ticks& ticks);
  template <class Since>
  State<double> state_at(double t, const Since& since) const {
    const auto particles = static_cast<Eigen::Index>(begin_.size());
    State<double> state{t, Coordinates<double>(particles, dimension_),
                        Coordinates<double>(particles, dimension_)};
    for (int i = 0; i < particles; ++i)
      evaluate(i, since(i), state.position.row(i).data(), state.velocity.row(i).data());
    return state;
  }
  Piece piece_about(double begin, double end, const std::function<double(int)>& since) const;
  template <int stride>
  void told(int particle, double* to, std::size_t next_order) const;
  template <int stride>
  bool update_padded(PartialExpansion& group, Count now, Report& report);
  bool finite_series(const double* c, int particle, Count now, Report& report) const;
  bool agrees(int particle, double time, double s, const double* c_2, Report& report) const;
  void publish(int particle, Count now, std::uint64_t group);
  void count(std::size_t updated);
  /// No step of a particle is longer than the Courant limit by these bounds of frequencies [rad/s] and dampings [1/s].
  void limit_steps(const std::vector<double>& frequencies, const std::vector<double>& dampings);
  void find_levels();
  bool refresh_limits(Count now, Report& report);

  ClockOptions options_;
  Stops stops_;
  int dimension_, stride_, order_;
  std::size_t size_;  // numbers in the series of a particle
  ModelAlong along_;
  Expansion<double> all_;
  std::vector<int> moving_, places_;
  std::vector<double> longest_;  // step of each particle [s]
  std::vector<int> coarsest_;    // level that is no longer than that
  std::optional<CourantSteps> stable_;
  std::optional<FrequencyMeter> meter_;        // where limits are of states
  std::optional<DampingMeter> damping_meter_;  // likewise
  std::uint64_t next_limits_ = 0;              // updates after which they are taken anew
  std::optional<CourantFrequency> frequency_;  // of the limits, where there are any
  std::vector<LastTwoAllows> allowed_;         // steps, by level; those that have been asked for
  Ticks ticks_;
  AlignedVector<double> series_;  // [particle][order][padded component]
  std::vector<Count> begin_;
  std::vector<int> degree_;  // of each particle's series
  std::vector<std::uint64_t> updates_;
  std::vector<double> shift_, rows_;  // room for an update
  StepsToKinks to_kinks_;
  bool watches_;                         // whether a force makes choices
  PartialExpansion* updated_ = nullptr;  // the group that was updated last; null: all
  std::vector<bool> to_change_;          // whether the step of a particle ends at the change of a choice
  std::vector<int> instants_;            // how many of these in a row had next to no length
  int sliding_ = -1;
  Report elements_report_;
  std::unique_ptr<SeriesNow> now_;       // room to look at elements that come and go
  std::vector<ShorterStep> shorter_;     // likewise
  std::vector<bool> to_other_elements_;  // whether the step of a particle ends where elements change
  std::vector<double> natural_;          // step [s] that the series of a particle in doubt asks for
  std::vector<int> former_;
  std::vector<Count> former_begin_;
  std::vector<int> former_degree_;
  std::vector<double> former_natural_, former_series_;
  std::uint64_t groups_ = 0, partial_coefficients_ = 0;
  std::uint64_t at_ends_ = 0;  // of looks at the ends of runs, however often they are stopped: not counted
  Work work_;
};

}  // namespace jetlag
