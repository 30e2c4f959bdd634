// SPDX-License-Identifier: MIT
#pragma once
// What a step of random degrees costs on average.

#include "jetlag/truncation/draws.hpp"
#include "jetlag/truncation/truncation.hpp"
#include "jetlag/truncation/velocity_series.hpp"

namespace jetlag {

/// How the degrees of one step are drawn.
struct StepDraws {
  Draw kind = Draw::independent;
  bool shared = true;  // one draw for all particles
  int particles = 1;   // that draw otherwise, >= 1
  int moving = 1;      // of these: the draws of the others do not matter
};

/// P(the largest of the degrees that a step draws >= n). Draws of different particles are independent,
///     1 - (1 - P)^M,      P = P(K >= n), M = moving particles,
/// but of `stratified` ones, one from each of N intervals of (0, 1], the first floor(N P) surely go that far and the
/// next one with the probability N P - floor(N P). Which M of the N are those of moving particles is random.
double largest_at_least(const TruncationLaw& law, const StepDraws& draws, int n);

/// The orders of the forces that a step computes on average: those of the positions up to the largest degree, with
/// own_series one more, and up to order `read` of the positions, but the two that the state gives.
double mean_orders(const TruncationLaw& law, const StepDraws& draws, VelocitySeries velocity, int read);

}  // namespace jetlag
