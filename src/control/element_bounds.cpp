// SPDX-License-Identifier: MIT
#include "control/element_bounds.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace jetlag {

// ---- in any state ----------------------------------------------------------------------------------------

namespace {

/// f(particles, its number) for each element with a known bound.
template <class F>
void for_each_known_square(const Model<double>& model, Input::Kind by, const std::vector<double>& load,
                           F use) {
  for_each_with(model, known_bound(by), [&](auto particles, double) {
    double sum = 0;
    for (const int i : particles) sum += load[i];
    use(particles, sum);
  });
}

/// Takes the largest number of each particle from those of its elements.
auto into(std::vector<double>& bound) {
  return [&bound](auto particles, double square) {
    for (const int i : particles) bound[i] = std::max(bound[i], square);
  };
}

const RecordedLaw* first_where(const Model<double>& model, Input::Kind by,
                               bool (*which)(const Model<double>::Law&, Input::Kind)) {
  const auto found = std::ranges::find_if(model.laws(), [&](const auto& law) { return which(*law, by); });
  return found == model.laws().end() ? nullptr : &(*found)->elements().law;
}

}  // namespace

bool has_unknown_bound(const Model<double>::Law& law, Input::Kind by) {
  const RecordedLaw& recorded = law.elements().law;
  return law.count() > 0 && recorded.*known_bound(by) == nullptr && reads(recorded, by);
}

bool needs_tangents(const Model<double>::Law& law, Input::Kind by) {
  return has_unknown_bound(law, by) && !law.elements().law.unbounded;
}

const RecordedLaw* first_unknown(const Model<double>& model, Input::Kind by) {
  return first_where(model, by, has_unknown_bound);
}

const RecordedLaw* first_that_needs_tangents(const Model<double>& model, Input::Kind by) {
  return first_where(model, by, needs_tangents);
}

std::vector<double> known_loads(const Model<double>& model, Input::Kind by) {
  std::vector<double> load(model.particles(), 0.0);
  for_each_with(model, known_bound(by), [&](auto particles, double k) {
    for (const int i : particles) load[i] += k * model.inverse_mass(i);
  });
  return load;
}

std::vector<double> known_bounds(const Model<double>& model, Input::Kind by) {
  std::vector<double> bound(model.particles(), 0.0);
  for_each_known_square(model, by, known_loads(model, by), into(bound));
  return bound;
}

double largest(const std::vector<double>& bounds) {
  return bounds.empty() ? 0.0 : *std::ranges::max_element(bounds);
}

// ---- at a state ------------------------------------------------------------------------------------------

namespace {

using Tangent = ElementBounds::Tangent;

Tangent symmetric_part(const Eigen::Map<const Eigen::MatrixXd>& k) { return 0.5 * (k + k.transpose()); }

/// In ascending order. K finite. In two steps: SelfAdjointEigenSolver's constructor would compile eigenvectors too.
Eigen::VectorXd eigenvalues(const Tangent& k) {
  const double largest = k.cwiseAbs().maxCoeff(), scale = largest > 0 ? largest : 1.0;
  const Eigen::Tridiagonalization<Tangent> narrow(k / scale);
  Eigen::SelfAdjointEigenSolver<Tangent> solver;
  solver.computeFromTridiagonal(narrow.diagonal(), narrow.subDiagonal(), Eigen::EigenvaluesOnly);
  return scale * solver.eigenvalues();
}

/// Whether K has no eigenvalue above c > 0: c - K is positive definite.
bool is_below(const Tangent& k, double c) {
  Tangent rest = -k;
  rest.diagonal().array() += c;
  return Eigen::LLT<Eigen::Ref<Tangent>>(rest).info() == Eigen::Success;
}

}  // namespace

ElementBounds::ElementBounds(const Model<double>& model, Input::Kind by)
    : model_(model), by_(by), known_load_(known_loads(model, by)) {
  for (std::size_t n = 0; n < model.laws().size(); ++n)
    if (needs_tangents(model.law(n), by))
      laws_.push_back({n, ElementTangents(model.laws()[n]), {}, {}, {}, {}});
}

ElementBounds::ElementBounds(const ElementBounds& other) : ElementBounds(other.model_, other.by_) {
  for (std::size_t n = 0; n < laws_.size(); ++n) {
    laws_[n].weight = other.laws_[n].weight;
    laws_[n].norm = other.laws_[n].norm;
    laws_[n].square = other.laws_[n].square;
    laws_[n].size = other.laws_[n].size;
  }
  largest_law_ = other.largest_law_;
  largest_element_ = other.largest_element_;
}

bool ElementBounds::take(const State<double>& state) {
  load_ = known_load_;
  for (auto& law : laws_) {
    law.tangents.take(state, by_);
    const auto count = static_cast<int>(law.tangents.law().count());
    law.weight.resize(count);
    law.norm.resize(count, 0.0);
    for (int e = 0; e < count; ++e) {
      const double norm = law.tangents.of(e).norm();
      if (!std::isfinite(norm)) return not_finite(law);
      weigh(law, e, norm);
      for (const int i : law.tangents.law().particles_of(e))
        load_[i] += law.weight[e] * model_.inverse_mass(i);
    }
  }
  return true;
}

const RecordedLaw* ElementBounds::first_not_positive() const {
  for (const auto& law : laws_)
    for (int e = 0; e < static_cast<int>(law.tangents.law().count()); ++e) {
      const auto k = law.tangents.of(e);
      const double little = 1e-6 * k.norm();
      if (little > 0 && !((k - k.transpose()).norm() <= little && is_below(-symmetric_part(k), little)))
        return &law.tangents.law().elements().law;
    }
  return nullptr;
}

bool ElementBounds::not_finite(const WeightedTangents& law) {
  culprit_ = law.tangents.law().elements().law.name;
  return false;
}

/// D^1/2 K_e D^1/2 / w_e. Zero for a weight of zero.
Tangent ElementBounds::shared(const WeightedTangents& law, int e) const {
  Tangent k = symmetric_part(law.tangents.of(e));
  if (!(law.weight[e] > 0)) return Tangent::Zero(k.rows(), k.cols());
  const auto particles = law.tangents.law().particles_of(e);
  const int dimension = model_.dimension();
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_rows> root(k.rows());
  for (Eigen::Index row = 0; row < root.size(); ++row)
    root(row) = std::sqrt(load_[particles[row / dimension]] / law.weight[e]);
  return root.asDiagonal() * k * root.asDiagonal();
}

double ElementBounds::square(const WeightedTangents& law, int e) const {
  const Tangent k = shared(law, e);
  return k.isZero(0) ? 0.0 : std::max(0.0, eigenvalues(k).maxCoeff());
}

std::vector<double> ElementBounds::bounds() {
  std::vector<double> bound(model_.particles(), 0.0);
  for_each_known_square(model_, by_, load_, into(bound));
  for (auto& law : laws_) {
    law.square.resize(law.weight.size(), -1.0);
    law.size.resize(law.weight.size(), 0.0);
    for (int e = 0; e < static_cast<int>(law.weight.size()); ++e) {
      bound_anew(law, e);
      into(bound)(law.tangents.law().particles_of(e), law.square[e]);
    }
  }
  return bound;
}

double ElementBounds::largest_square() {
  constexpr double equal = 1 + 1e-9;
  double most = 0;
  for_each_known_square(model_, by_, load_, [&](auto, double square) { most = std::max(most, square); });
  if (laws_.empty()) return most;
  most = std::max(most, square(laws_[largest_law_], largest_element_));
  for (std::size_t n = 0; n < laws_.size(); ++n)
    for (int e = 0; e < static_cast<int>(laws_[n].weight.size()); ++e) {
      if (most > 0 && is_below(shared(laws_[n], e), most * equal)) continue;
      if (const double own = square(laws_[n], e); own > most) {
        most = own;
        largest_law_ = n;
        largest_element_ = e;
      }
    }
  return most;
}

void ElementBounds::bound_anew(WeightedTangents& law, int e) const {
  const Tangent k = shared(law, e);
  const double size = k.norm();
  double& square = law.square[e];
  const bool is_first = square < 0;
  if (square > 0 && size > 0.8 * law.size[e] && is_below(k, square)) return;
  law.size[e] = size;
  square = size == 0 ? 0.0 : std::max(0.0, eigenvalues(k).maxCoeff()) * (is_first ? 1.0 : 1.05);
}

/// kappa_e / 2 at first, and where that was zero, as of a tangent without a symmetric part; later it goes with the norm.
void ElementBounds::weigh(WeightedTangents& law, int e, double norm) {
  if (law.norm[e] > 0 && law.weight[e] > 0)
    law.weight[e] *= norm / law.norm[e];
  else
    law.weight[e] =
        norm > 0 ? 0.5 * eigenvalues(symmetric_part(law.tangents.of(e))).cwiseAbs().maxCoeff() : 0.0;
  law.norm[e] = norm;
}

}  // namespace jetlag
