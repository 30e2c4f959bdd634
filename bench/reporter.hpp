// SPDX-License-Identifier: MIT
#pragma once
// What the benchmarks print: machine and compiler, whether the engines agree, the usual console output of
// Google Benchmark with the fastest repetition of each benchmark, and ratios beside the goals set for them.

#include <benchmark/benchmark.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace jetlag::bench {

class Reporter final : public benchmark::ConsoleReporter {
 public:
  Reporter() : ConsoleReporter(OO_Tabular) {}

  /// Prints where it runs and whether the engines agree. Unless they do, nothing is run.
  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

  bool failed() const { return disagreement_ || failed_run_; }

  /// Time of an iteration of a benchmark in its fastest repetition; empty when it was not run.
  std::optional<double> nanoseconds(const std::string& benchmark) const;
  /// What a benchmark counted, and the time divided by its counter "items".
  std::optional<double> counter(const std::string& benchmark, const std::string& name) const;
  std::optional<double> nanoseconds_of_an_item(const std::string& benchmark) const;

 private:
  std::optional<double> ratio(const std::string& numerator, const std::string& denominator) const;
  /// b in  cost = a N^b,  fitted by least squares of the logarithms.
  std::optional<double> exponent(const std::string& stem, const std::vector<int>& degrees) const;

  void print_ratios();

  std::map<std::int64_t, Run> fastest_;  // by the order of registration
  bool disagreement_ = false, failed_run_ = false;
};

}  // namespace jetlag::bench
