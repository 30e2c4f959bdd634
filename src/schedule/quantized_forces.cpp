// SPDX-License-Identifier: MIT
#include "schedule/quantized_forces.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace jetlag {

QuantizedForces::QuantizedForces(const Model<double>& model, int orders, Signal signal)
    : model_(model),
      orders_(orders),
      stride_(padded(model.dimension())),
      signal_(std::move(signal)),
      places_(model.particles(), -1),
      seen_(model.particles(), false) {
  for (std::size_t law = 0; law < model.laws().size(); ++law) {
    laws_.push_back(ElementBlocks<double>::none_of(model.law(law).forces(), orders_));
    if (model.law(law).count() > 0) parts_[laws_[law].reads_velocity()].laws.push_back(law);
  }
  for (Part& part : parts_) add_links(part);
}

void QuantizedForces::add_links(Part& part) {
  part.of.resize(model_.particles());
  if (part.laws.empty()) return;
  for (int i = 0; i < model_.particles(); ++i) {
    part.of[i].push_back(static_cast<int>(part.forces.size()));
    part.forces.push_back({-1, i});
  }
  std::map<std::pair<int, int>, bool> known;
  for (const std::size_t law : part.laws) {
    if (laws_[law].participants() != 2) continue;
    for (const int e : model_.law(law).all()) {
      const auto ends = model_.law(law).particles_of(e);
      const auto [a, b] = std::minmax(ends[0], ends[1]);
      if (!known.emplace(std::pair(a, b), true).second) continue;
      for (const int i : {a, b}) part.of[i].push_back(static_cast<int>(part.forces.size()));
      part.forces.push_back({a, b});
    }
  }
}

/// Row 0 is the particle, row r the other end of its link r, one more row for pushes that nobody reads.
void QuantizedForces::fill(const Part& part, int particle, double time) {
  const auto& links = part.of[particle];
  rows_ = links.size() + 1;
  const std::size_t order = rows_ * stride_;
  for (auto* rows : {&x_, &v_})
    if (rows->size() < orders_ * order) rows->resize(orders_ * order);
  for (std::size_t r = 0; r < links.size(); ++r) {
    const Force& link = part.forces[links[r]];
    const int i = r == 0 ? particle : link.first == particle ? link.second : link.first;
    places_[i] = static_cast<int>(r);
    signal_(0, i, time, x_.data() + r * stride_, order);
    if (&part == &parts_[1]) signal_(1, i, time, v_.data() + r * stride_, order);
  }
}

/// The forces of its elements, into f_: of pairs on the other end, of others on the particle.
void QuantizedForces::run(const Part& part, int particle, double time) {
  fill(part, particle, time);
  const std::size_t order = rows_ * stride_;
  auto& f = f_[&part == &parts_[1]];
  f.assign(orders_ * order, 0.0);
  const int waste = static_cast<int>(rows_) - 1;
  for (const std::size_t number : part.laws) {
    auto& law = laws_[number];
    const auto& all = model_.law(number);
    const auto elements = all.of(particle);
    if (elements.empty()) continue;
    const bool pair = law.participants() == 2;
    law.take(
        all.forces(), all.elements().particles, elements, kernels<double>(),
        [&](int i) { return places_[i]; }, [&](int i) { return pair && i == particle ? waste : places_[i]; });
    for (int k = 0; k < orders_; ++k) {
      if (law.running(k, 1) == 0) continue;
      const MotionRows<double> motion{x_.data() + k * order, v_.data() + k * order, order, time, 1.0};
      law.push_all(k, 1, motion, f.data() + k * order);
      element_coefficients_ += elements.size();
    }
  }
}

bool QuantizedForces::renew(int kind, int particle, double time) {
  pushed_.clear();
  const auto depends = [&](std::size_t p) { return !parts_[p].laws.empty() && (kind == 0 || p == 1); };
  for (std::size_t p = 0; p < 2; ++p)
    if (depends(p)) {
      run(parts_[p], particle, time);
      if (!std::ranges::all_of(f_[p], [](double f) { return std::isfinite(f); })) return false;
    }
  for (std::size_t p = 0; p < 2; ++p) {
    if (!depends(p)) continue;
    const auto& links = parts_[p].of[particle];
    const std::size_t order = (links.size() + 1) * stride_;
    for (std::size_t r = 0; r < links.size(); ++r) {
      Force& force = parts_[p].forces[links[r]];
      const bool other_is_first = force.first >= 0 && force.second == particle;
      force.time = time;
      for (int k = 0; k < orders_; ++k)
        for (int c = 0; c < model_.dimension(); ++c) {
          const double on_other = f_[p][k * order + r * stride_ + c];
          force.c[k][c] = other_is_first ? -on_other : on_other;
        }
      const int i = r == 0 ? particle : other_is_first ? force.first : force.second;
      if (seen_[i] || model_.is_fixed(i)) continue;
      seen_[i] = true;
      pushed_.push_back(i);
    }
  }
  for (const int i : pushed_) seen_[i] = false;
  return true;
}

std::array<std::array<double, 3>, 3> QuantizedForces::acceleration(int particle, double time) const {
  std::array<std::array<double, 3>, 3> a{};
  for (const Part& part : parts_)
    for (const int number : part.of[particle]) {
      const Force& force = part.forces[number];
      const double sign = force.first == particle ? -1.0 : 1.0, s = time - force.time;
      for (int c = 0; c < model_.dimension(); ++c) {
        const double f0 = force.c[0][c], f1 = force.c[1][c], f2 = force.c[2][c];
        a[0][c] += sign * (f0 + s * (f1 + s * f2));
        a[1][c] += sign * (f1 + 2 * s * f2);
        a[2][c] += sign * f2;
      }
    }
  for (auto& order : a)
    for (double& component : order) component *= model_.inverse_mass(particle);
  return a;
}

}  // namespace jetlag
