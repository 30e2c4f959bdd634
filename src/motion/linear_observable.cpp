// SPDX-License-Identifier: MIT
// Observables that are linear in time, positions and velocities, such as a coordinate: their series are read off those of the motion.

#include <algorithm>
#include <cmath>

#include "jetlag/motion/observable.hpp"
#include "motion/terms.hpp"

namespace jetlag {

namespace {

/// The series of one input along a piece, coefficient by coefficient: 0 beyond the last one.
class InputSeries {
 public:
  InputSeries(const PieceView& piece, const Input& input) {
    if (input.kind == Input::Kind::time) {
      time_[0] = piece.begin;
      c_ = time_;
      size_ = 2;
      return;
    }
    const CoefficientsView& all = input.kind == Input::Kind::position ? piece.position : piece.velocity;
    c_ = all.row(0, input.participant) + input.component;
    next_ = all.numbers_of_each();
    size_ = all.size();
  }
  InputSeries(const InputSeries&) = delete;
  InputSeries& operator=(const InputSeries&) = delete;

  std::size_t size() const { return size_; }
  double operator[](std::size_t k) const { return k < size_ ? c_[k * next_] : 0.0; }

 private:
  double time_[2]{0, 1};
  const double* c_ = nullptr;
  std::size_t next_ = 1, size_ = 0;
};

/// sum_{k>0} |c(k)| h^k, k < size, even and odd powers apart, so that they do not wait for each other.
template <class C>
double sum_of_sizes(const C& c, std::size_t size, double h) {
  const double square = h * h;
  double even = 0, odd = 0;
  std::size_t k = size - 1;
  if (k % 2 == 1) odd = std::abs(c(k--));
  for (; k > 0; k -= 2) {
    even = (even + std::abs(c(k))) * square;
    odd = odd * square + std::abs(c(k - 1));
  }
  return even + h * odd;
}

/// The sign of c_0 if it is that of  c(s) = sum_{k<size} c_k s^k  for all s from 0 to h, because  |c_0| > sum_{k>0} |c_k| h^k,  or
/// because c goes one way, |c_1| > sum_{k>1} k |c_k| h^(k-1), and has this sign at h; all by more than rounding, if c_0 is a sum
/// of terms of these sizes. 0 where that does not tell.
template <class C>
int sign_up_to(const C& c, std::size_t size, double c_0, double sizes, double h) {
  constexpr double more = 1.001, rounding = 0x1p-40;
  if (!(std::abs(c_0) > rounding * sizes)) return 0;
  const double rest = sum_of_sizes(c, size, h);
  if (std::abs(c_0) > more * rest) return sign(c_0);
  double slope = 0, end = 0;
  for (std::size_t k = size; k-- > 1;) {
    if (k > 1) slope = (slope + static_cast<double>(k) * std::abs(c(k))) * h;
    end = (end + c(k)) * h;
  }
  end += c_0;
  const bool stays =
      std::abs(c(1)) > more * slope && c_0 * end > 0 && std::abs(end) > rounding * (sizes + rest);
  return stays ? sign(c_0) : 0;
}

}  // namespace

/// Where no rule reads older coefficients and nothing is chosen, g is linear. Coefficient 1 where that of one input is 1 is the
/// weight of this input; the constant has no part in it.
void ObservableSeries::find_linear_terms() {
  const Program& program = blocks_.program();
  is_linear_ = program.histories == 0 && program.conditions.empty() && !program.is_static;
  if (!is_linear_) return;
  for (const auto& loaded : program.inputs) *blocks_.at(0, loaded.place, 0) = 0.0;
  blocks_.run(0, 0);
  constant_ = coefficient(0);
  blocks_.reserve(2);
  for (const auto& loaded : program.inputs) *blocks_.at(0, loaded.place, 1) = 0.0;
  for (const auto& [place, input] : program.inputs) {
    *blocks_.at(0, place, 1) = 1.0;
    blocks_.run(0, 1);
    terms_.push_back({input, coefficient(1)});
    *blocks_.at(0, place, 1) = 0.0;
  }
}

int ObservableSeries::sign_along(const PieceView& piece) const {
  if (!is_linear_ || terms_.empty() || piece.unit != 1) return 0;
  const double h = piece.end - piece.begin;
  if (terms_.size() == 1) {  // without a loop over terms: most events are these
    const InputSeries x(piece, terms_[0].input);
    const double weight = terms_[0].weight, first = weight * x[0];
    return sign_up_to([&](std::size_t k) { return weight * x[k]; }, x.size(), constant_ + first,
                      std::abs(constant_) + std::abs(first), h);
  }
  double first = constant_, sizes = std::abs(constant_);
  std::size_t size = 2;
  for (const auto& [input, weight] : terms_) {
    const InputSeries x(piece, input);
    first += weight * x[0];
    sizes += std::abs(weight * x[0]);
    size = std::max(size, x.size());
  }
  const auto c = [&](std::size_t k) {
    double sum = 0;
    for (const auto& [input, weight] : terms_) sum += weight * InputSeries(piece, input)[k];
    return sum;
  };
  return sign_up_to(c, size, first, sizes, h);
}

/// The coefficients of g along a piece where it reads no more than two inputs, so that there is one way to add them up, and where all
/// of them are finite; otherwise none.
std::vector<double> ObservableSeries::combined(const PieceView& piece) {
  std::vector<double> c;
  if (!is_linear_ || terms_.empty() || terms_.size() > 2) return c;
  const InputSeries x(piece, terms_.front().input), y(piece, terms_.back().input);
  const std::size_t size = std::max(x.size(), y.size());
  c.resize(size);
  const auto& inputs = blocks_.program().inputs;
  for (std::size_t i = 0; i < inputs.size(); ++i) *blocks_.at(0, inputs[i].place, 0) = i == 0 ? x[0] : y[0];
  blocks_.run(0, 0);
  c[0] = coefficient(0);
  const double of_x = terms_.front().weight, of_y = terms_.size() == 2 ? terms_.back().weight : 0;
  for (std::size_t k = 1; k < size; ++k) c[k] = of_y == 0 ? of_x * x[k] : of_x * x[k] + of_y * y[k];
  if (!std::ranges::all_of(c, [](double number) { return std::isfinite(number); })) c.clear();
  return c;
}

}  // namespace jetlag
