// SPDX-License-Identifier: MIT
#pragma once
// The register of pages, by families. To add a method, add its entry to the list of one: the build then reads the
// comments of the headers named in `declared`, and tests/scenes/methods/methods_test.cpp checks keys, defaults, examples and
// proofs.
//
// Pairs of a header and a symbol are read by .cmake/method_docs.cmake too, from every method_register*.cpp: write both
// as plain text, as they are there.

#include "scenes/methods/methods.hpp"

namespace jetlag {

/// Taylor's methods with one clock for all.
std::vector<MethodPage> taylor_pages();

/// Methods of others that take one step after another with all particles.
std::vector<MethodPage> one_step_pages();

/// Methods with many clocks: of each particle, element or component.
std::vector<MethodPage> clock_pages();

}  // namespace jetlag
