// SPDX-License-Identifier: MIT
#pragma once
// The series of particles with clocks of their own, about one time.

#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "jetlag/model/changing_elements.hpp"
#include "jetlag/series/calculus/polynomial.hpp"
#include "schedule/local/local_motion.hpp"

namespace jetlag {

/// A series is shifted when it is asked for, once for each time.
class SeriesNow final : public MotionAhead {
 public:
  explicit SeriesNow(const LocalMotion& motion)
      : MotionAhead(0),
        motion_(motion),
        orders_(motion.degree() + 1),
        stride_(padded(motion.model().dimension())),
        series_(static_cast<std::size_t>(motion.model().particles()) * motion.told_size()),
        shifted_(motion.model().particles(), 0) {}

  void move_to(Ticks::Count now, std::function<double(int)> left) {
    now_ = now;
    set_time(motion_.ticks().time(now));
    left_ = std::move(left);
    ++look_;
  }

  PathView path(int particle) const override {
    double* const c = series_.data() + particle * motion_.told_size();
    if (std::exchange(shifted_[particle], look_) != look_) {
      motion_.told(particle, c);
      const double s = motion_.ticks().seconds(now_ - motion_.begin_of(particle));
      if (s != 0)
        for (int first = 0; first + 1 < orders_; ++first)  // taylor_shift, of all components
          for (int n = orders_ - 2; n >= first; --n)
            for (int d = 0; d < stride_; ++d) c[n * stride_ + d] += s * c[(n + 1) * stride_ + d];
    }
    return {c, stride_, orders_ - 1, 1.0, motion_.model().dimension()};
  }
  double left(int particle) const override {
    return motion_.model().fixed()[particle] ? std::numeric_limits<double>::infinity() : left_(particle);
  }

 private:
  const LocalMotion& motion_;
  Ticks::Count now_ = 0;
  std::function<double(int)> left_;
  int orders_, stride_;
  mutable std::vector<double> series_;          // [particle][order][padded component]
  mutable std::vector<std::uint64_t> shifted_;  // in which look
  std::uint64_t look_ = 0;
};

}  // namespace jetlag
