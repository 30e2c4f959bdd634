// SPDX-License-Identifier: MIT
#pragma once
// Studies: tables made by running many scenes. To add one, write its file and add its line to studies.cpp.

#include <CLI/App.hpp>
#include <functional>
#include <optional>

namespace jetlag {

/// A study with its arguments; returns an exit code.
using Study = std::function<int()>;

/// Adds `study NAME` for each study, and `stability`; the one that is called is put into `chosen`.
void add_studies(CLI::App& app, std::optional<Study>& chosen);

}  // namespace jetlag
