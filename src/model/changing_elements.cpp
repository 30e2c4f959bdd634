// SPDX-License-Identifier: MIT
#include "jetlag/model/changing_elements.hpp"

#include <algorithm>

namespace jetlag {

ModelAlong::ModelAlong(const System<double>& system) : model_(Model<double>::without_changing(system)) {
  for (const auto& [elements, first_law] : system.changing())
    parts_.push_back(elements->follow(model_, first_law));
}

ModelAlong::ModelAlong(const ModelAlong& other) : model_(other.model_) {
  for (const auto& part : other.parts_) parts_.push_back(part->clone());
}

bool ModelAlong::begin(const State<double>& state) {
  bool changed = false;
  for (const auto& part : parts_) changed |= part->begin(state, model_);
  return changed;
}

double ModelAlong::up_to_change(const PositionSeries& position, double h, Report& report) {
  for (const auto& part : parts_) h = h > 0 ? part->up_to_change(position, h, report) : 0.0;
  return h;
}

bool ModelAlong::is_safe(const PositionSeries& position, double h, bool is_given, Report& report) {
  return std::ranges::all_of(parts_,
                             [&](const auto& part) { return part->is_safe(position, h, is_given, report); });
}

void ModelAlong::take(double h, const Coordinates<double>& position) {
  for (const auto& part : parts_) part->take(h, position);
}

bool ModelAlong::follow_clocks() const {
  return std::ranges::all_of(parts_, [](const auto& part) { return part->follows_clocks(); });
}

bool ModelAlong::change(const MotionAhead& motion, std::span<const int> due) {
  bool changed = false;
  for (const auto& part : parts_) changed |= part->change(motion, due, model_);
  return changed;
}

bool ModelAlong::find_changes(const MotionAhead& motion, std::span<const int> updated,
                              std::vector<ShorterStep>& shorter, Report& report) {
  return std::ranges::all_of(
      parts_, [&](const auto& part) { return part->find_changes(motion, updated, shorter, report); });
}

}  // namespace jetlag
