// SPDX-License-Identifier: MIT
#pragma once
// The register of benchmarks: to add one, write its file, declare it here and call it in main.cpp.

#include <benchmark/benchmark.h>

#include "problems.hpp"

namespace jetlag::bench {

void register_expansion();   // BM_Expansion/<problem>/<degree>, BM_FromEnergy/<law>/<how>
void register_restart();     // BM_Restart/<problem>/<degree>, BM_RestartTape/<problem>/<degree>
void register_adolc();       // BM_ExpansionAdolC/<problem>/<degree>, nothing without ADOL-C
void register_engine();      // engine/<what>: one table of the engine's speed
void register_step();        // BM_Step/<method>/<problem>
void register_checks();      // BM_Check/<problem>/<degree>/<what>
void register_asynchrony();  // BM_Asynchrony/<problem>/<degree>, BM_EventQueue/<clocks>
void register_solids();  // BM_Solid/<law>/<tetrahedra>/<degree>, BM_SolidAdolC/<degree>, BM_Beam/<method>/<steps>
void register_peers();  // BM_Peers/<problem>/<digits>/<method>

/// Counters of a run whose iteration expands the whole problem once: elements, and the time for each of them.
inline void count_elements(benchmark::State& run, const Problem& problem) {
  using benchmark::Counter;
  const auto elements = static_cast<double>(element_count(problem.system));
  run.counters["items"] = elements;
  run.counters["per_element"] = Counter(elements, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

}  // namespace jetlag::bench
