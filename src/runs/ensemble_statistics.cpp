// SPDX-License-Identifier: MIT
#include "runs/ensemble_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace jetlag {

std::vector<Quantity> quantities_of(const Scene& scene, bool velocities) {
  std::vector<Quantity> quantities;
  for (int i = 0; i < scene.system->particles(); ++i)
    for (const bool of_velocity : {false, true})
      for (int c = 0; c < scene.system->dimension(); ++c)
        if (!scene.system->fixed()[i] && (!of_velocity || velocities))
          quantities.push_back({i, c, of_velocity});
  if (scene.output.energy) quantities.push_back({});
  return quantities;
}

/// The value of every quantity in a state.
template <class Put>
void EnsembleStatistics::values(const State<double>& state, const Put& put) {
  auto meter = meters_.lend([&] { return std::make_unique<EnergyMeter>(system_); });
  for (std::size_t q = 0; q < quantities_.size(); ++q) {
    const auto& [particle, component, of_velocity] = quantities_[q];
    put(q, particle < 0  ? (*meter)(state).total()
           : of_velocity ? state.velocity(particle, component)
                         : state.position(particle, component));
  }
  meters_.give_back(std::move(meter));
}

EnsembleFrame EnsembleStatistics::at(double time, const std::vector<std::size_t>& members,
                                     const StateOf& state_of, const State<double>* reference) {
  constexpr std::size_t together = 16;  // members, quantities
  const std::size_t n = members.size(), count = quantities_.size();
  values_.resize(n * count);
  workers_.each((n + together - 1) / together, [&](std::size_t part) {
    for (std::size_t i = part * together; i < std::min(n, (part + 1) * together); ++i)
      values(state_of(members[i]), [&](std::size_t q, double x) { values_[q * n + i] = x; });
  });
  EnsembleFrame frame;
  frame.time = time;
  frame.members = n;
  frame.samples.resize(count);
  workers_.each((count + together - 1) / together, [&](std::size_t part) {
    for (std::size_t q = part * together; q < std::min(count, (part + 1) * together); ++q)
      frame.samples[q] = sample_of({values_.data() + q * n, n});
  });
  frame.reference.assign(count, Calibration::not_known);
  if (reference) values(*reference, [&](std::size_t q, double x) { frame.reference[q] = x; });
  frame.calibration = calibration(frame);
  return frame;
}

/// The mean square of member - reference is that of the members about their mean and that of the mean:
///     sum_i (x_i - r)^2 / n = (n - 1)/n s^2 + (mean - r)^2.
Calibration EnsembleStatistics::calibration(const EnsembleFrame& frame) const {
  double spread = 0, members = 0, mean = 0, count = 0;
  const auto n = static_cast<double>(frame.members);
  for (std::size_t q = 0; q < quantities_.size(); ++q) {
    if (!is_position(q)) continue;
    const Sample& sample = frame.samples[q];
    const double of_mean = sample.mean - frame.reference[q];
    const double own = n > 1 ? (n - 1) / n * sample.spread * sample.spread : 0.0;
    spread += sample.spread * sample.spread;
    members += own + of_mean * of_mean;
    mean += of_mean * of_mean;
    ++count;
  }
  const auto root = [&](double sum) { return std::sqrt(sum / count); };
  return {root(spread), root(members), root(mean)};
}

double EnsembleStatistics::error(const EnsembleFrame& frame, const State<double>& state) const {
  double sum = 0, count = 0;
  for (std::size_t q = 0; q < quantities_.size(); ++q) {
    if (!is_position(q)) continue;
    const double of_run =
        state.position(quantities_[q].particle, quantities_[q].component) - frame.reference[q];
    sum += of_run * of_run;
    ++count;
  }
  return std::sqrt(sum / count);
}

}  // namespace jetlag
