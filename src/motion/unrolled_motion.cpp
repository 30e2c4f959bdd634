// SPDX-License-Identifier: MIT
#include "jetlag/motion/unrolled_motion.hpp"

namespace jetlag {

namespace {

/// The law of the only element that acts; null if there are several or none.
const Model<double>::Law* law_of_only_element(const Model<double>& model) {
  const Model<double>::Law* only = nullptr;
  for (const auto& law : model.laws()) {
    if (law->count() == 0) continue;
    if (law->count() > 1 || only != nullptr) return nullptr;
    only = law.get();
  }
  return only;
}

}  // namespace

UnrolledMotion<double>::UnrolledMotion(const Model<double>& model, const KernelTable<double>& table) {
  const auto* law = law_of_only_element(model);
  if (!table.fuses || law == nullptr) return;
  const RecordedLaw& recorded = law->elements().law;
  if (recorded.participants != model.particles() || !recorded.force.conditions.empty()) return;
  if (recorded.kernel.orders == 0) return;
  for (const int particle : law->particles_of(0)) rows_.push_back(particle * padded(model.dimension()));
  parameters_ = detail::parameters_with_masses(model.mass(), law->elements(), law->all());
  time_.assign(orders_of_histories, 0.0);
  histories_.resize(most_histories * orders_of_histories);
  const int histories = count_histories(recorded.kernel);
  if (histories > most_histories) return;
  histories_.resize(histories * orders_of_histories);
  histories_.shrink_to_fit();
  kernel_ = recorded.kernel;
}

/// At order 0, on numbers that mean nothing.
int UnrolledMotion<double>::count_histories(const LawKernel& kernel) {
  std::vector<double> rows(3 * rows_.size() * 4, 1.0);
  return kernel.grow({rows.data(), rows.data(), time_.data(), rows.data(), 1.0, rows_.data(),
                      parameters_.data(), histories_.data()},
                     0, 1);
}

}  // namespace jetlag
