// SPDX-License-Identifier: MIT
#include "model/element_jacobian.hpp"

#include <algorithm>
#include <utility>

namespace jetlag {

namespace {
constexpr bool has_colours(int participants) { return participants <= 2; }
}  // namespace

ElementJacobian::ElementJacobian(const Model<double>& model,
                                 const std::function<bool(std::span<const int>)>& wanted,
                                 const std::function<bool(int)>& column)
    : particles_(model.particles()),
      dimension_(model.dimension()),
      stride_(padded(model.dimension())),
      touched_(particles_, false),
      fixed_(model.fixed()),
      is_column_(particles_, false),
      neighbours_(particles_),
      rows_(particles_) {
  std::vector<bool> is_coloured(particles_, false);  // whether an element with colours acts on it
  for (const auto& law : model.laws()) {
    const bool by_colours = has_colours(law->elements().law.participants);
    std::vector<int> chosen;
    for (const int e : law->all()) {
      const auto members = law->particles_of(e);
      if (!wanted(members)) continue;
      chosen.push_back(e);
      for (const int i : members) {
        touched_[i] = true;
        if (!by_colours) continue;
        is_coloured[i] = true;
        for (const int j : members)
          if (j != i && !fixed_[i] && !fixed_[j]) neighbours_[i].push_back(j);
      }
    }
    if (chosen.empty()) continue;
    laws_.push_back(law->blocks(law->elements().law.force, kernels<double>(), chosen));
    laws_.back().reserve(2);
    reads_velocity_ = reads_velocity_ || laws_.back().reads_velocity();
    if (!by_colours) tangents_.emplace_back(law, std::move(chosen));
  }
  for (int i = 0; i < particles_; ++i) {
    auto& neighbours = neighbours_[i];
    std::ranges::sort(neighbours);
    neighbours.erase(std::ranges::unique(neighbours).begin(), neighbours.end());
    is_column_[i] = touched_[i] && !fixed_[i] && column(i);
    if (!is_column_[i] || !is_coloured[i]) continue;
    rows_[i] = {i};
    rows_[i].insert(rows_[i].end(), neighbours.begin(), neighbours.end());
  }
  const std::size_t size = static_cast<std::size_t>(particles_) * stride_;
  x_.assign(2 * size, 0.0);
  v_.assign(2 * size, 0.0);
  f_.assign(size, 0.0);
}

/// Greedily: the first colour that none of those has upon whom a neighbour acts.
void ElementJacobian::colour() {
  if (std::exchange(is_coloured_, true)) return;
  const auto all =
      static_cast<std::size_t>(std::ranges::count_if(rows_, [](const auto& r) { return !r.empty(); }));
  std::vector<int> colour(particles_, -1), taken_by;  // of each colour: the last particle that cannot have it
  for (int i = 0; i < particles_; ++i) {
    if (rows_[i].empty()) continue;
    std::size_t free = 0;
    if (rows_[i].size() >= all) {  // it acts upon all
      free = colours_.size();
    } else {
      const auto take = [&](int j) {
        if (colour[j] >= 0) taken_by[colour[j]] = i;
      };
      for (const int j : rows_[i]) {
        take(j);
        for (const int k : neighbours_[j]) take(k);
      }
      while (free < colours_.size() && taken_by[free] == i) ++free;
    }
    colour[i] = static_cast<int>(free);
    if (free == colours_.size()) {
      colours_.emplace_back();
      taken_by.push_back(-1);
    }
    colours_[free].push_back(i);
  }
}

/// Adds coefficient k of the forces of a law.
void ElementJacobian::run(ElementBlocks<double>& law, int k) {
  if (law.running(k, 1) == 0) return;
  const std::size_t size = f_.size();
  // A unit of time of 0: the time stands still along a direction.
  const MotionRows<double> motion{x_.data() + k * size, v_.data() + k * size, size, state_.time, 0.0};
  law.push_all(k, 1, motion, f_.data());
  element_coefficients_ += law.count();
}

/// Coefficient k of the forces of all.
void ElementJacobian::run(int k) {
  std::ranges::fill(f_, 0.0);
  for (auto& law : laws_) run(law, k);
}

void ElementJacobian::run_coloured() {
  std::ranges::fill(f_, 0.0);
  for (auto& law : laws_)
    if (has_colours(law.participants())) run(law, 1);
}

Coordinates<double> ElementJacobian::result() const {
  Coordinates<double> force(particles_, dimension_);
  for (int i = 0; i < particles_; ++i)
    for (int c = 0; c < dimension_; ++c) force(i, c) = f_[i * stride_ + c];
  return force;
}

Coordinates<double> ElementJacobian::force(const State<double>& state) {
  state_ = state;
  for (int i = 0; i < particles_; ++i)
    for (int c = 0; c < dimension_; ++c) {
      x_[i * stride_ + c] = state.position(i, c);
      v_[i * stride_ + c] = state.velocity(i, c);
    }
  run(0);
  return result();
}

Coordinates<double> ElementJacobian::product(const Coordinates<double>& u, const Coordinates<double>& w) {
  double *const x = x_.data() + f_.size(), *const v = v_.data() + f_.size();
  for (int i = 0; i < particles_; ++i)
    for (int c = 0; c < dimension_; ++c) {
      x[i * stride_ + c] = fixed_[i] ? 0.0 : u(i, c);
      v[i * stride_ + c] = fixed_[i] ? 0.0 : w(i, c);
    }
  run(1);
  std::fill_n(x, f_.size(), 0.0);  // as `derivatives` expects them
  std::fill_n(v, f_.size(), 0.0);
  return result();
}

void ElementJacobian::derivatives(By by, std::vector<JacobianEntry>& entries) {
  colour();
  entries.clear();
  if (by == By::velocity && !reads_velocity_) return;
  double* const direction = (by == By::position ? x_ : v_).data() + f_.size();
  for (const auto& colour : colours_)
    for (int c = 0; c < dimension_; ++c) {
      for (const int i : colour) direction[i * stride_ + c] = 1;
      run_coloured();
      for (const int i : colour) {
        direction[i * stride_ + c] = 0;
        for (const int row : rows_[i])
          for (int r = 0; r < dimension_; ++r)
            entries.push_back({row * dimension_ + r, i * dimension_ + c, f_[row * stride_ + r]});
      }
    }
  add_tangents(by, entries);
}

void ElementJacobian::add_tangents(By by, std::vector<JacobianEntry>& entries) {
  for (auto& law : tangents_) {
    if (by == By::velocity && !law.reads_velocity()) continue;
    law.take(state_, by == By::position ? Input::Kind::position : Input::Kind::velocity);
    element_coefficients_ += (law.size() + 1) * law.chosen().size();
    entries.reserve(entries.size() + law.chosen().size() * law.size() * law.size());
    for (std::size_t n = 0; n < law.chosen().size(); ++n) {
      const auto particles = law.law().particles_of(law.chosen()[n]);
      const auto tangent = law.of(static_cast<int>(n));
      for (int column = 0; column < law.size(); ++column) {
        const int j = particles[column / dimension_];
        if (!is_column_[j]) continue;
        for (int row = 0; row < law.size(); ++row)
          if (const int i = particles[row / dimension_]; !fixed_[i])
            entries.push_back({i * dimension_ + row % dimension_, j * dimension_ + column % dimension_,
                               -tangent(row, column)});
      }
    }
  }
}

}  // namespace jetlag
