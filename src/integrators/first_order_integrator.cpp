// SPDX-License-Identifier: MIT
#include "jetlag/integrators/first_order_integrator.hpp"

#include <stdexcept>
#include <string>

namespace jetlag {

State<double> first_order_state(double time, const std::vector<double>& y) {
  const auto size = static_cast<Eigen::Index>(y.size());
  return {time, Eigen::Map<const Coordinates<double>>(y.data(), size, 1), Coordinates<double>::Zero(size, 1)};
}

double FirstOrderIntegrator::step(State<double>& state, double limit, Report& report) {
  if (state.position.rows() != size_ || state.position.cols() != 1)
    throw std::invalid_argument("first_order: the state must have the shape (" + std::to_string(size_) +
                                ", 1)");
  const auto numbers = [](const Coordinates<double>& rows) {
    return std::vector<double>(rows.data(), rows.data() + rows.size());
  };
  FirstOrderState<> y{state.time, numbers(state.position), numbers(state.position_rest)};
  const double h = taylor_.step(y, limit, report);
  if (h == 0) return 0;
  begin_ = state.time;
  last_step_ = h;
  State<double> end = first_order_state(state.time, y.y);
  end.velocity = piece().at(begin_ + h).velocity;
  if (!y.rest.empty()) end.position_rest = first_order_state(0, y.rest).position;
  state = std::move(end);
  return h;
}

Piece FirstOrderIntegrator::piece() const {
  const auto c = taylor_.polynomials();
  const double unit = taylor_.series().time_unit();
  Piece piece{begin_, begin_ + last_step_, {}, {}, unit};
  const auto orders = c.empty() ? 0 : c.front().size();
  for (std::size_t k = 0; k < orders; ++k) {
    Coordinates<double> row(size_, 1);
    for (int i = 0; i < size_; ++i) row(i, 0) = c[i][k];
    if (k > 0) piece.velocity.push_back(static_cast<double>(k) / unit * row);
    piece.position.push_back(row);
  }
  if (piece.velocity.empty()) piece.velocity.push_back(Coordinates<double>::Zero(size_, 1));
  return piece;
}

}  // namespace jetlag
