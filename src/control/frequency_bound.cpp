// SPDX-License-Identifier: MIT
#include "jetlag/control/frequency_bound.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "control/laws_with.hpp"
#include "jetlag/base/text.hpp"
#include "model/element_tangents.hpp"

namespace jetlag {

// ---- in any state ----------------------------------------------------------------------------------------

namespace {

/// Adds the sum of stiffness / mass at each particle.
void add_loads_of_stiffness(const Model<double>& model, std::vector<double>& load) {
  for_each_with(model, &RecordedLaw::stiffness, [&](auto particles, double k) {
    for (const int i : particles) load[i] += k * model.inverse_mass(i);
  });
}

/// f(particles, omega_e^2) for each element with a stiffness.
template <class F>
void for_each_square_of_stiffness(const Model<double>& model, const std::vector<double>& load, F use) {
  for_each_with(model, &RecordedLaw::stiffness, [&](auto particles, double) {
    double sum = 0;
    for (const int i : particles) sum += load[i];
    use(particles, sum);
  });
}

/// Takes the largest square of each particle from those of its elements.
auto into(std::vector<double>& bound) {
  return [&bound](auto particles, double square) {
    for (const int i : particles) bound[i] = std::max(bound[i], square);
  };
}

std::vector<double> roots(std::vector<double> squares) {
  for (double& b : squares) b = std::sqrt(b);
  return squares;
}

double largest(const std::vector<double>& bounds) {
  return bounds.empty() ? 0.0 : *std::ranges::max_element(bounds);
}

/// Whether a law acts on positions and has no stiffness.
bool has_unknown_stiffness(const Model<double>::Law& law) {
  const RecordedLaw& recorded = law.elements().law;
  return law.count() > 0 && recorded.stiffness == nullptr && reads(recorded, Input::Kind::position);
}

bool needs_state(const Model<double>::Law& law) {
  return has_unknown_stiffness(law) && !law.elements().law.unbounded;
}

/// The first such law; null if there is none.
const RecordedLaw* first_where(const Model<double>& model, bool (*which)(const Model<double>::Law&)) {
  const auto found = std::ranges::find_if(model.laws(), [&](const auto& law) { return which(*law); });
  return found == model.laws().end() ? nullptr : &(*found)->elements().law;
}

}  // namespace

std::vector<double> frequency_bounds(const Model<double>& model) {
  std::vector<double> load(model.particles(), 0.0), bound(model.particles(), 0.0);
  add_loads_of_stiffness(model, load);
  for_each_square_of_stiffness(model, load, into(bound));
  return roots(std::move(bound));
}

double frequency_bound(const Model<double>& model) { return largest(frequency_bounds(model)); }

bool bounds_need_state(const Model<double>& model) { return first_where(model, needs_state) != nullptr; }

std::string unbounded_force(const Model<double>& model) {
  const RecordedLaw* law = first_where(model, has_unknown_stiffness);
  return law == nullptr ? "" : law->name;
}

void require_bounded(const Model<double>& model) {
  if (const auto* law = first_where(model, needs_state))
    throw std::invalid_argument("courant: no stiffness is known of " + law->name +
                                ", so that nothing bounds the step in all states; say at which state, or "
                                "leave courant out");
}

// ---- at a state ------------------------------------------------------------------------------------------

namespace {

/// On the stack: a tangent of as many participants as there may be.
constexpr int most_rows = 3 * most_participants;
using Tangent = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most_rows, most_rows>;

/// Tangents by velocities are not bounded here.
void require_no_velocities(const RecordedLaw& law) {
  if (reads(law, Input::Kind::velocity))
    throw std::invalid_argument(
        "courant: " + law.name +
        " depends on velocities and says no damping, so that nothing bounds the step; "
        "leave courant out");
}

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

/// All elements at one state.
class FrequencyMeter::Elements {
 public:
  explicit Elements(const Model<double>& model) : model_(model), load_of_stiffness_(model.particles(), 0.0) {
    add_loads_of_stiffness(model, load_of_stiffness_);
    for (std::size_t n = 0; n < model.laws().size(); ++n)
      if (needs_state(model.law(n))) {
        require_no_velocities(model.law(n).elements().law);
        laws_.push_back({n, ElementTangents(model.laws()[n]), {}, {}, {}, {}});
      }
  }

  Elements(const Elements& other) : Elements(other.model_) {
    for (std::size_t n = 0; n < laws_.size(); ++n) {
      laws_[n].weight = other.laws_[n].weight;
      laws_[n].norm = other.laws_[n].norm;
      laws_[n].square = other.laws_[n].square;
      laws_[n].size = other.laws_[n].size;
    }
    largest_law_ = other.largest_law_;
    largest_element_ = other.largest_element_;
  }

  Elements(Elements&&) = default;

  struct WeightedTangents {
    std::size_t number;  // of the law
    ElementTangents tangents;
    std::vector<double> weight,
        norm;  // of each element, and Frobenius's norm of the tangent when it was found
    std::vector<double> square, size;  // that bounds omega_e^2, and the norm of `shared` when it was found
  };
  const std::vector<WeightedTangents>& laws() const { return laws_; }
  const std::vector<double>& load() const { return load_; }
  const Model<double>& model() const { return model_; }

  /// Moves on to a state. False where a tangent is not finite.
  bool take(const State<double>& state) {
    load_ = load_of_stiffness_;
    for (auto& law : laws_) {
      law.tangents.take(state);
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

  /// The name of the law that was not finite.
  const std::string& culprit() const { return culprit_; }

  /// D^1/2 K_e D^1/2 / w_e. Zero for a weight of zero.
  Tangent shared(const WeightedTangents& law, int e) const {
    Tangent k = symmetric_part(law.tangents.of(e));
    if (!(law.weight[e] > 0)) return Tangent::Zero(k.rows(), k.cols());
    const auto particles = law.tangents.law().particles_of(e);
    const int dimension = model_.dimension();
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_rows> root(k.rows());
    for (Eigen::Index row = 0; row < root.size(); ++row)
      root(row) = std::sqrt(load_[particles[row / dimension]] / law.weight[e]);
    return root.asDiagonal() * k * root.asDiagonal();
  }
  /// omega_e^2, 0 where nothing oscillates.
  double square(const WeightedTangents& law, int e) const {
    const Tangent k = shared(law, e);
    return k.isZero(0) ? 0.0 : std::max(0.0, eigenvalues(k).maxCoeff());
  }

  /// Bounds of omega of each particle.
  std::vector<double> bounds() {
    std::vector<double> bound(model_.particles(), 0.0);
    for_each_square_of_stiffness(model_, load_, into(bound));
    for (auto& law : laws_) {
      law.square.resize(law.weight.size(), -1.0);
      law.size.resize(law.weight.size(), 0.0);
      for (int e = 0; e < static_cast<int>(law.weight.size()); ++e) {
        bound_anew(law, e);
        into(bound)(law.tangents.law().particles_of(e), law.square[e]);
      }
    }
    return roots(std::move(bound));
  }

  /// The largest omega_e^2, to 1e-9: begins with the element that had it last, with which most need only be compared.
  double largest_square() {
    constexpr double equal = 1 + 1e-9;
    double most = 0;
    for_each_square_of_stiffness(model_, load_, [&](auto, double square) { most = std::max(most, square); });
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

 private:
  bool not_finite(const WeightedTangents& law) {
    culprit_ = law.tangents.law().elements().law.name;
    return false;
  }

  void bound_anew(WeightedTangents& law, int e) const {
    const Tangent k = shared(law, e);
    const double size = k.norm();
    double& square = law.square[e];
    const bool is_first = square < 0;
    if (square > 0 && size > 0.8 * law.size[e] && is_below(k, square)) return;
    law.size[e] = size;
    square = size == 0 ? 0.0 : std::max(0.0, eigenvalues(k).maxCoeff()) * (is_first ? 1.0 : 1.05);
  }

  /// kappa_e / 2 at first, and where that was zero, as of a tangent without a symmetric part; later it goes with the norm.
  static void weigh(WeightedTangents& law, int e, double norm) {
    if (law.norm[e] > 0 && law.weight[e] > 0)
      law.weight[e] *= norm / law.norm[e];
    else
      law.weight[e] =
          norm > 0 ? 0.5 * eigenvalues(symmetric_part(law.tangents.of(e))).cwiseAbs().maxCoeff() : 0.0;
    law.norm[e] = norm;
  }

  Model<double> model_;
  std::vector<double> load_of_stiffness_, load_;
  std::vector<WeightedTangents> laws_;
  std::string culprit_;
  std::size_t largest_law_ = 0;
  int largest_element_ = 0;
};

FrequencyMeter::FrequencyMeter(const Model<double>& model) : elements_(std::make_unique<Elements>(model)) {}
FrequencyMeter::FrequencyMeter(const FrequencyMeter& other)
    : elements_(std::make_unique<Elements>(*other.elements_)) {}
FrequencyMeter::~FrequencyMeter() = default;

double FrequencyMeter::operator()(const State<double>& state) {
  return elements_->take(state) ? std::sqrt(elements_->largest_square())
                                : std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> FrequencyMeter::of_particles(const State<double>& state) {
  return elements_->take(state) ? elements_->bounds() : std::vector<double>();
}

FrequencyMeter::Elements FrequencyMeter::at(const Model<double>& model, const State<double>& state) {
  Elements elements(model);
  if (!elements.take(state))
    throw std::invalid_argument("courant: the tangent of " + elements.culprit() +
                                " is not finite at t = " + shown(state.time) +
                                ", so that nothing bounds the step; begin elsewhere, or leave courant out");
  return elements;
}

std::vector<double> frequency_bounds(const Model<double>& model, const State<double>& state) {
  return bounds_need_state(model) ? FrequencyMeter::at(model, state).bounds() : frequency_bounds(model);
}

double frequency_bound(const Model<double>& model, const State<double>& state) {
  return largest(frequency_bounds(model, state));
}

std::vector<std::vector<double>> frequency_bounds_of_elements(const Model<double>& model,
                                                              const State<double>& state) {
  const auto elements = FrequencyMeter::at(model, state);
  std::vector<std::vector<double>> bounds(model.laws().size());
  for (std::size_t n = 0; n < bounds.size(); ++n) bounds[n].assign(model.law(n).count(), 0.0);
  for (std::size_t n = 0; n < bounds.size(); ++n) {
    const auto& [recorded, particles, parameters] = model.law(n).elements();
    if (recorded.stiffness == nullptr) continue;
    for (const int e : model.law(n).all())
      for (const int i : model.law(n).particles_of(e)) bounds[n][e] += elements.load()[i];
    bounds[n] = roots(std::move(bounds[n]));
  }
  for (const auto& law : elements.laws())
    for (const int e : law.tangents.law().all()) bounds[law.number][e] = std::sqrt(elements.square(law, e));
  return bounds;
}

}  // namespace jetlag
