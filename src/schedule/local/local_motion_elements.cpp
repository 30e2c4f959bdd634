// SPDX-License-Identifier: MIT
// Elements that come and go among particles with clocks of their own.
#include <algorithm>
#include <limits>

#include "schedule/local/local_motion.hpp"
#include "schedule/local/series_now.hpp"

namespace jetlag {

LocalMotion::~LocalMotion() = default;

void LocalMotion::begin_elements(const State<double>& state) {
  to_other_elements_.assign(to_other_elements_.size(), false);
  elements_report_ = {};
  if (along_.none()) return;
  if (along_.begin(state)) all_.move_to(model());
  now_ = std::make_unique<SeriesNow>(*this);
}

bool LocalMotion::change_elements(Count now, std::span<const int> due) {
  if (along_.none()) return false;
  now_->move_to(now, {});
  if (!along_.change(*now_, due)) return false;
  all_.move_to(model());
  return true;
}

/// left(i): what is left of the step of a particle [s].
void LocalMotion::up_to_other_elements(Count now, std::span<const int> particles,
                                       const std::function<double(int)>& left,
                                       std::vector<Kinks::Step>& shortened) {
  for (const int i : particles) to_other_elements_[i] = false;
  now_->move_to(now, left);
  shorter_.clear();
  if (!along_.find_changes(*now_, particles, shorter_, elements_report_)) return;
  for (const auto& [i, h] : shorter_) {
    if (model().fixed()[i]) continue;
    to_other_elements_[i] = true;
    natural_[i] = step_of(i);
    shortened.push_back({i, h, 0.0});
  }
}

}  // namespace jetlag
