// SPDX-License-Identifier: MIT
#if !defined(__x86_64__)
#define JETLAG_INSTRUCTION_SET_NAME plain
#endif
#include "ensembles/system_lanes.hpp"

#include <algorithm>
#include <string_view>

#include "jetlag/model/system_tape.hpp"

namespace jetlag {

#if defined(__x86_64__)
namespace sse2 {
extern const EnsembleLanes ensemble;
}
namespace avx2 {
extern const EnsembleLanes ensemble;
}
namespace avx512 {
extern const EnsembleLanes ensemble;
}
#endif

const EnsembleLanes& ensemble_lanes([[maybe_unused]] const char* instruction_set) {
#if defined(__x86_64__)
  if (std::string_view(instruction_set) == "avx512") return avx512::ensemble;
  if (std::string_view(instruction_set) == "avx2") return avx2::ensemble;
  return sse2::ensemble;  // also beside the scalar kernels
#else
  return plain::ensemble;
#endif
}

namespace {

/// All positions get a place where every order is kept: new orders are written there, nothing is copied.
std::vector<Place> keep_positions(Program& program, int components, int dimension) {
  std::vector<Place> series(components, Place{Place::Space::history, -1});
  const auto rename = [&](Place from, Place to) {
    const auto in = [&](Place& place) {
      if (place.space == from.space && place.slot == from.slot) place = to;
    };
    for (auto* instructions : {&program.preparation, &program.instructions})
      for (Instruction& instruction : *instructions)
        for (Place& place : instruction.operands) in(place);
    for (Place& place : program.outputs) in(place);
    for (auto& loaded : program.inputs) in(loaded.place);
  };
  for (std::size_t i = 0; i < program.inputs.size(); ++i) {
    const auto [place, input] = program.inputs[i];
    if (input.kind != Input::Kind::position) continue;
    Place& kept = series[input.participant * dimension + input.component];
    kept = place.space == Place::Space::history ? place : Place{Place::Space::history, program.histories++};
    if (place.space != Place::Space::history) rename(place, kept);
  }
  for (Place& place : series)
    if (place.slot < 0) place.slot = program.histories++;
  std::erase_if(program.inputs,
                [](const auto& loaded) { return loaded.input.kind == Input::Kind::position; });
  return series;
}

}  // namespace

SystemLanes::SystemLanes(const Model<double>& model)
    : particles(model.particles()),
      dimension(model.dimension()),
      components(particles * dimension),
      fixed(model.fixed()),
      program(system_tape(model)) {
  for (const auto& law : model.laws()) elements += law->count();
  for (int i = 0; i < particles; ++i)
    inverse_mass.insert(inverse_mass.end(), dimension, model.inverse_mass(i));
  series = keep_positions(program, components, dimension);
  for (const auto& loaded : program.inputs)
    reads_velocity = reads_velocity || loaded.input.kind == Input::Kind::velocity;
}

/// With s = (t - t_0) / unit:   v_k = (k+1) x_{k+1} / unit,   x_{k+2} = F_k unit^2 / (m (k+1) (k+2)).
void SystemLanes::grow(Blocks<double>& blocks, const EnsembleLanes& of, const double* time, int order,
                       double unit, int known) const {
  const int lanes = blocks.lanes(), last = order - 2;
  for (int k = known - 1; k <= last;) {
    const int orders = !reads_velocity && k < last ? 2 : 1;
    for (const auto& [place, input] : program.inputs)
      for (int n = k; n < k + orders; ++n) {
        double* to = blocks.at(0, place, n);
        const std::size_t c = static_cast<std::size_t>(input.participant) * dimension + input.component;
        if (input.kind == Input::Kind::time) {
          for (int i = 0; i < lanes; ++i) to[i] = n == 0 ? time[i] : n == 1 ? unit : 0.0;
        } else {  // a velocity: positions are read where they stand
          of.scale(lanes, (n + 1) / unit, blocks.at(0, series[c], n + 1), to);
        }
      }
    blocks.run(0, k, orders);
    for (int c = 0; c < components; ++c) {
      if (inverse_mass[c] == 0.0) continue;
      const Place output = program.outputs[c];
      const double push = inverse_mass[c] * unit * unit;
      const bool constant = output.space == Place::Space::statics;
      double* to = blocks.at(0, series[c], k + 2);
      if (orders == 2 && !constant) {
        const double of_this = push / ((k + 1.0) * (k + 2.0)), of_next = push / ((k + 2.0) * (k + 3.0));
        of.scale_two(lanes, of_this, of_next, blocks.at(0, output, k), blocks.at(0, output, k + 1), to);
        continue;
      }
      for (int n = k; n < k + orders; ++n, to += lanes)
        if (n > 0 && constant)
          std::fill_n(to, lanes, 0.0);
        else
          of.scale(lanes, push / ((n + 1.0) * (n + 2.0)), blocks.at(0, output, n), to);
    }
    k += orders;
  }
}

}  // namespace jetlag
